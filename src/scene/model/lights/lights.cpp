#include "scene/model/lights/lights.h"

#include "scene/model/vector_math.h"

#include <cstddef>
#include <typeinfo>
#include <unordered_map>
#include <utility>

namespace nusselt::scene {

LightList& Lights::list_like(const LightList& other) {
    for (LightList& list : *this)
        if (typeid(list) == typeid(other)) return list;
    lists_.push_back(other.empty_list());
    return *lists_.back();
}

void Lights::append(Lights&& others) {
    for (LightList& list : others) list_like(list).append(std::move(list));
}

void Lights::append(std::vector<Lights> parts) {
    if (parts.size() > 1) {
        std::unordered_map<LightList*, std::size_t> counts;
        for (const Lights& part : parts)
            for (const LightList& list : part) counts[&list_like(list)] += list.size();
        for (const auto& [list, count] : counts) list->reserve(list->size() + count);
    }
    for (Lights& part : parts) append(std::move(part));
}

} // namespace nusselt::scene
