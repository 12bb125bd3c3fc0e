/// The arrays of the hierarchy for shaders.

#include "meshes.h"
#include "visibility/triangle_bvh.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>

namespace nusselt::gpu_visibility_test {
namespace {

using visibility::make_triangle_bvh;
using visibility::TriangleBvh;
using visibility_test::kAbsent;
using visibility_test::kFull;
using visibility_test::kPartial;
using visibility_test::make_empty_scene;

template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

/// Numbers of the triangles below nodes [first, end), with flags; EXPECTs that boxes hold what is in them.
std::vector<std::uint32_t> triangles_in(const TriangleBvh& bvh, std::uint32_t first, std::uint32_t end) {
    std::vector<std::uint32_t> found;
    std::function<std::uint32_t(std::uint32_t)> visit = [&](std::uint32_t node) {
        const interface::BvhNode& box = bvh.nodes[node];
        const std::uint32_t kind = box.link & interface::kBvhKindMask;
        std::uint32_t index = box.link & ~interface::kBvhKindMask;
        if (kind == interface::kBvhInner) {
            std::uint32_t child = node + 1;
            while (child < index) {
                for (int axis = 0; axis < 3; ++axis) {
                    EXPECT_LE(box.lower[axis], bvh.nodes[child].lower[axis]);
                    EXPECT_GE(box.upper[axis], bvh.nodes[child].upper[axis]);
                }
                child = visit(child);
            }
            EXPECT_EQ(child, index) << "the last child ends where its parent does";
            return index;
        }
        if (kind == interface::kBvhInstance) return node + 1;
        for (;; ++index) {
            for (int k = 0; k < 9; ++k) {
                EXPECT_LE(box.lower[k % 3], bvh.triangles[index].corner[k]);
                EXPECT_GE(box.upper[k % 3], bvh.triangles[index].corner[k]);
            }
            found.push_back(bvh.triangles[index].number & ~interface::kBvhLastOfLeaf);
            if ((bvh.triangles[index].number & interface::kBvhLastOfLeaf) != 0) return node + 1;
        }
    };
    for (std::uint32_t node = first; node < end;) node = visit(node);
    std::sort(found.begin(), found.end());
    return found;
}

std::vector<std::uint32_t> triangles_in(const TriangleBvh& bvh, std::size_t instance) {
    return triangles_in(bvh, bvh.instances[instance].first_node, bvh.instances[instance].end_node);
}

TEST(TriangleBvh, HasEachTriangleOnce) {
    std::mt19937 random(1);
    scene::Scene scene = make_empty_scene();
    visibility_test::add_soup(scene, 1000, random);
    std::vector<std::uint32_t> all(1000);
    for (std::uint32_t i = 0; i < 1000; ++i) all[i] = i;
    EXPECT_EQ(triangles_in(make_triangle_bvh(scene), 0), all);
}

TEST(TriangleBvh, LeavesOutWhatRaysCannotHit) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    scene::Scene scene = make_empty_scene();
    using visibility_test::add_triangle;
    add_triangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, kAbsent);
    add_triangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, kPartial);
    add_triangle(scene, {0, kNan, 0}, {1, 0, 0}, {0, 1, 0}, kFull);
    add_triangle(scene, {0, 0, 0}, {1, 0, -kInfinity}, {0, 1, 0}, kFull);
    add_triangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 2e18f, 0}, kFull);
    add_triangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1e18f, 0}, kFull);
    EXPECT_EQ(triangles_in(make_triangle_bvh(scene), 0),
              (std::vector<std::uint32_t>{5, 1 | interface::kBvhPartial}));
}

TEST(TriangleBvh, OfNothingIsEmpty) {
    const TriangleBvh bvh = make_triangle_bvh(make_empty_scene());
    EXPECT_TRUE(bvh.nodes.empty());
    ASSERT_EQ(bvh.instances.size(), 1u);
    EXPECT_EQ(bvh.instances[0].first_node, bvh.instances[0].end_node);
}

TEST(TriangleBvh, StoresObjectsOnce) {
    std::mt19937 random(2);
    scene::Scene scene = make_empty_scene();
    visibility_test::add_box(scene, {0, 0, 0}, {1, 1, 1});
    visibility_test::add_soup(scene, 100, random);
    visibility_test::make_object(scene, 12);
    add_instances(scene, 0, random);
    const TriangleBvh bvh = make_triangle_bvh(scene);
    EXPECT_EQ(bvh.triangles.size(), 112u);
    ASSERT_EQ(bvh.instances.size(), 11u);
    EXPECT_EQ(triangles_in(bvh, 0).size(), 12u);
    for (std::size_t i = 1; i < 11; ++i) {
        EXPECT_EQ(triangles_in(bvh, i).size(), 100u);
        EXPECT_EQ(triangles_in(bvh, i).front(), 12u);
    }
}

TEST(TriangleBvh, DoesNotDependOnThreads) {
    std::mt19937 random(3);
    scene::Scene scene = make_empty_scene();
    // Enough for the builder to split its work.
    visibility_test::add_soup(scene, 30000, random);
    visibility_test::make_object(scene, 10000);
    add_instances(scene, 0, random);
    const auto build_with = [&](int threads) {
        tbb::task_arena arena(threads);
        return arena.execute([&] { return make_triangle_bvh(scene); });
    };
    const TriangleBvh one = build_with(1);
    for (int repetition = 0; repetition < 4; ++repetition) {
        const TriangleBvh two = build_with(2);
        ASSERT_TRUE(same(one.nodes, two.nodes));
        ASSERT_TRUE(same(one.triangles, two.triangles));
        ASSERT_TRUE(same(one.instances, two.instances));
    }
}

} // namespace
} // namespace nusselt::gpu_visibility_test
