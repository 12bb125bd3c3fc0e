#include "scene/model/lights/light_kinds.h"

#include "scene/model/vector_math.h"

namespace nusselt::scene {

namespace {

template <class... Kinds>
Lights lists_of() {
    Lights lights;
    (lights.of<Kinds>(), ...);
    return lights;
}

} // namespace

Lights no_lights_of_each_kind() {
    return lists_of<PolygonLight, RoundLight, LineLight, PointLight, DistantLight, EnvironmentLight>();
}

} // namespace nusselt::scene
