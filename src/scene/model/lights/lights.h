#pragma once
/// Lights of several kinds.

#include "scene/model/lights/light_list.h"

#include <iterator>

namespace nusselt::scene {

template <class Light>
inline constexpr bool kIsSurface = requires(const Light& light, LightSurface& surface) {
    LightKind<Light>::add_surface(light, surface);
};

template <class Light>
class LightsOf final : public LightList {
public:
    using Kind = LightKind<Light>;

    std::unique_ptr<LightList> copy() const override { return std::make_unique<LightsOf>(*this); }
    std::unique_ptr<LightList> empty_list() const override { return std::make_unique<LightsOf>(); }
    void append(LightList&& others) override {
        std::vector<Light>& added = static_cast<LightsOf&>(others).lights;
        if (lights.capacity() == 0)
            lights = std::move(added);
        else
            lights.insert(lights.end(), std::make_move_iterator(added.begin()),
                          std::make_move_iterator(added.end()));
        added = std::vector<Light>(); // `= {}` would keep the memory
    }
    void reserve(std::size_t count) override { lights.reserve(count); }
    void clear() override { lights.clear(); }

    std::string_view name() const override { return Kind::kName; }
    std::string_view noun() const override { return Kind::kNoun; }
    std::string_view plural() const override { return Kind::kPlural; }
    bool scales_evenly() const override { return Kind::kScalesEvenly; }
    bool has_brdf_samples() const override { return Kind::kHasBrdfSamples; }
    const EmissionQuantity& quantity() const override { return Kind::kQuantity; }
    std::size_t size() const override { return lights.size(); }
    std::size_t bytes() const override { return lights.size() * sizeof(Light); }
    void add_to(Bounds& bounds) const override {
        for (const Light& light : lights) Kind::add_to(light, bounds);
    }
    void hash(ContentHash& hash) const override {
        for (const Light& light : lights) Kind::hash(light, hash);
    }
    void add_to(Moment& moment) const override {
        for (const Light& light : lights) Kind::add_moment(light, moment);
    }
    void transform(const Transform& transform) override {
        for (Light& light : lights) Kind::transform(light, transform);
    }

    using LightList::emitter, LightList::emission, LightList::two_sided;
    const std::uint32_t& emitter(std::size_t i) const override { return lights[i].emitter; }
    const Float3& emission(std::size_t i) const override { return lights[i].*Kind::kEmission; }
    Double3 flux_per_emission(std::size_t i, double scene_radius) const override {
        return Kind::flux_per_emission(lights[i], scene_radius);
    }
    bool is_valid(std::size_t i) const override { return Kind::is_valid(lights[i]); }
    bool same_shape(std::size_t i, const LightList& others, std::size_t k) const override {
        const auto* const same_kind = dynamic_cast<const LightsOf*>(&others);
        return same_kind != nullptr && Kind::same_shape(lights[i], same_kind->lights[k]);
    }
    const bool* two_sided(std::size_t i) const override { return Kind::two_sided(lights[i]); }
    void add_mesh(std::size_t i, LightMesh& mesh) const override { Kind::add_mesh(lights[i], mesh); }
    bool is_surface() const override { return kIsSurface<Light>; }
    void add_surface([[maybe_unused]] std::size_t i, [[maybe_unused]] LightSurface& surface) const override {
        if constexpr (kIsSurface<Light>) Kind::add_surface(lights[i], surface);
    }
    double hit(std::size_t i, const SightRay& ray) const override { return Kind::hit(lights[i], ray); }
    std::string describe(std::size_t begin, std::size_t end, double scene_radius) const override {
        return Kind::describe(std::span(lights).subspan(begin, end - begin), scene_radius);
    }
    std::string rig_field(std::size_t i) const override { return Kind::rig_field(lights[i]); }
    void copy_to(LightList& others, std::size_t i) const override {
        static_cast<LightsOf&>(others).lights.push_back(lights[i]);
    }

    std::vector<Light> lights;
};

/// A list for each kind of light. Lights are numbered in the order of the lists.
class Lights {
    using Handle = std::unique_ptr<LightList>;

public:
    /// Iterates over the lists.
    template <class List>
    class Iterator {
    public:
        explicit Iterator(const Handle* position) : position_(position) {}
        List& operator*() const { return **position_; }
        Iterator& operator++() {
            ++position_;
            return *this;
        }
        bool operator!=(const Iterator& other) const { return position_ != other.position_; }

    private:
        const Handle* position_;
    };
    using ConstIterator = Iterator<const LightList>;
    using MutableIterator = Iterator<LightList>;

    Lights() = default;
    Lights(const Lights& other) { *this = other; }
    Lights(Lights&&) noexcept = default;
    Lights& operator=(Lights&&) noexcept = default;
    Lights& operator=(const Lights& other) {
        std::vector<Handle> copies;
        for (const auto& list : other.lists_) copies.push_back(list->copy());
        lists_ = std::move(copies);
        return *this;
    }
    ~Lights() = default;

    ConstIterator begin() const { return ConstIterator(lists_.data()); }
    ConstIterator end() const { return ConstIterator(lists_.data() + lists_.size()); }
    MutableIterator begin() { return MutableIterator(lists_.data()); }
    MutableIterator end() { return MutableIterator(lists_.data() + lists_.size()); }

    /// The lights of one kind. A kind without a list gets one after the others.
    template <class Light>
    std::vector<Light>& of() {
        if (LightsOf<Light>* const found = find<Light>()) return found->lights;
        lists_.push_back(std::make_unique<LightsOf<Light>>());
        return static_cast<LightsOf<Light>&>(*lists_.back()).lights;
    }
    template <class Light>
    const std::vector<Light>& of() const {
        static const std::vector<Light> kNone;
        const LightsOf<Light>* const found = find<Light>();
        return found == nullptr ? kNone : found->lights;
    }

    /// Moves the lights of others to the ends of the lists of their kinds.
    void append(Lights&& others);
    /// The same for all parts. Each list takes its memory at once, because lists that grow exist twice for a while.
    void append(std::vector<Lights> parts);
    /// Copies likewise.
    void append(const Lights& others) { append(Lights(others)); }
    void append(const LightList& others, std::size_t i) { others.copy_to(list_like(others), i); }
    /// Empties all lists.
    void clear() {
        for (LightList& list : *this) list.clear();
    }

    /// The number of lights of all kinds.
    std::size_t size() const {
        std::size_t sum = 0;
        for (const LightList& list : *this) sum += list.size();
        return sum;
    }
    bool empty() const { return size() == 0; }

private:
    template <class Light>
    LightsOf<Light>* find() const {
        for (const auto& list : lists_)
            if (auto* const found = dynamic_cast<LightsOf<Light>*>(list.get())) return found;
        return nullptr;
    }
    LightList& list_like(const LightList& other);

    std::vector<Handle> lists_;
};

/// One light alone.
template <class Light>
Lights only(const Light& light) {
    Lights lights;
    lights.of<Light>() = {light};
    return lights;
}

} // namespace nusselt::scene
