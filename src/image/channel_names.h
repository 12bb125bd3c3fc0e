#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace nusselt::image {

/// The names of the channels of a layer, which do not change. Copies share them: for a million layers, there is one list.
class ChannelNames {
public:
    using const_iterator = std::vector<std::string>::const_iterator;
    using value_type = std::string;

    ChannelNames(std::vector<std::string> names = {})
        : names_(std::make_shared<const std::vector<std::string>>(std::move(names))) {}
    ChannelNames(std::initializer_list<std::string> names) : ChannelNames(std::vector<std::string>(names)) {}

    // There are no moves, which would leave a list without names.
    ChannelNames(const ChannelNames&) = default;
    ChannelNames& operator=(const ChannelNames&) = default;
    ~ChannelNames() = default;

    std::size_t size() const { return names_->size(); }
    bool empty() const { return names_->empty(); }
    const std::string& operator[](std::size_t channel) const { return (*names_)[channel]; }
    const_iterator begin() const { return names_->begin(); }
    const_iterator end() const { return names_->end(); }

    friend bool operator==(const ChannelNames& a, const ChannelNames& b) { return *a.names_ == *b.names_; }

private:
    std::shared_ptr<const std::vector<std::string>> names_;
};

} // namespace nusselt::image
