#include "scene/model/lights/lights.h"

#include "scene/model/vector_math.h"

#include <typeinfo>

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

} // namespace nusselt::scene
