#pragma once
/// A camera that a person flies.

#include "scene/model/scene.h"
#include "scene/model/vector_math.h"

namespace nusselt::viewer {

/// Turns about an axis of the world that stays upright: that which is closest to what is up in the image at first.
class FlyCamera {
public:
    /// \param width, height of the film that the raster positions of the camera refer to [pixels]
    FlyCamera(const scene::Camera& start, int width, int height);

    /// Angles by which the view turns to the right and upwards [rad]. It never passes the upright axis.
    void turn(double right, double up);

    /// Moves on a sphere about a point, to its right and upwards as seen in the image [rad], and turns so that the point stays
    /// where it is in the image.
    void orbit(const scene::Double3& pivot, double right, double up);

    /// Moves to the right, downwards and into the image [m].
    void move(const scene::Double3& by);

    scene::Camera camera() const;

    /// Unit vectors in the middle of the image; zero if the camera has none.
    scene::Double3 forward() const;
    scene::Double3 right() const;
    scene::Double3 down() const;
    /// The axis that stays upright.
    const scene::Double3& up() const { return up_; }
    /// The middle of where rays start.
    scene::Double3 position() const;

private:
    void turn_about(const scene::Double3& pivot, double to_the_right, double upwards);
    void rotate(const scene::Double3& pivot, const scene::Double3& axis, double angle);

    double width_, height_;
    // The same members as in scene::Camera.
    scene::Double3 origin_, origin_right_, origin_down_, corner_, right_, down_;
    scene::Double3 up_; ///< unit
};

} // namespace nusselt::viewer
