#include "bench/queries/bullet_queries.hpp"

#include <btBulletCollisionCommon.h>

namespace camdir::bench {
namespace {

btVector3 to_bullet(const Vec3f& v) {
    return {v.x(), v.y(), v.z()};
}

}  // namespace

struct BulletQueries::World {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btCollisionWorld world{&dispatcher, &broadphase, &configuration};
    btTriangleMesh mesh;
    std::unique_ptr<btBvhTriangleMeshShape> shape;
    btCollisionObject object;

    explicit World(const scene::Scene& scene) {
        for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
            const auto [a, b, c] = corners(scene, i);
            mesh.addTriangle(to_bullet(a.cast<float>()), to_bullet(b.cast<float>()),
                             to_bullet(c.cast<float>()));
        }
        shape = std::make_unique<btBvhTriangleMeshShape>(&mesh, true);
        object.setCollisionShape(shape.get());
        world.addCollisionObject(&object);
    }
    ~World() { world.removeCollisionObject(&object); }

    [[nodiscard]] float sweep(const btConvexShape& moving, const Vec3f& from, const Vec3f& to) const {
        const btTransform begin(btQuaternion::getIdentity(), to_bullet(from));
        const btTransform end(btQuaternion::getIdentity(), to_bullet(to));
        btCollisionWorld::ClosestConvexResultCallback hit(begin.getOrigin(), end.getOrigin());
        world.convexSweepTest(&moving, begin, end, hit);
        return hit.hasHit() ? hit.m_closestHitFraction : 1.0F;
    }
};

BulletQueries::BulletQueries(const scene::Scene& scene) : world_(std::make_unique<World>(scene)) {}
BulletQueries::BulletQueries(BulletQueries&&) noexcept = default;
BulletQueries::~BulletQueries() = default;

float BulletQueries::sweep(const Vec3f& from, const Vec3f& to, float radius) const {
    return world_->sweep(btSphereShape(radius), from, to);
}

float BulletQueries::sweep_cube(const Vec3f& from, const Vec3f& to, float half) const {
    return world_->sweep(btBoxShape({half, half, half}), from, to);
}

}  // namespace camdir::bench
