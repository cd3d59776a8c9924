#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/collision_geometry.h>
#include <fcl/narrowphase/collision_object.h>

#include <memory>

#include "bench/peers/peer.hpp"

namespace app {
namespace {

using Object = fcl::CollisionObjectd;

// A shape that is nothing but a box of ours: FCL's own box would round its corners.
class BoxShape : public fcl::CollisionGeometryd {
 public:
  BoxShape(const Box& box, int id) : id(id), box_(box) { computeLocalAABB(); }
  void computeLocalAABB() override {
    aabb_local.min_ = box_.lo;
    aabb_local.max_ = box_.hi;
  }
  const int id;

 private:
  const Box& box_;
};

int id_of(const Object* object) {
  return static_cast<const BoxShape*>(object->collisionGeometry().get())->id;
}

// The primitives of one kind, their objects and their tree.
class Group {
 public:
  void update(const std::vector<Box>& boxes, Tree tree) {
    const bool first = objects_.empty();
    if (first) make_objects(boxes);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      shapes_[i]->computeLocalAABB();
      objects_[i].computeAABB();
    }
    if (first || tree == Tree::built) {
      manager_.clear();
      manager_.registerObjects(pointers_);
      manager_.setup();
    } else {
      manager_.update();
    }
  }
  fcl::DynamicAABBTreeCollisionManagerd& manager() { return manager_; }

 private:
  void make_objects(const std::vector<Box>& boxes) {
    objects_.reserve(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      shapes_.push_back(std::make_shared<BoxShape>(boxes[i], int(i)));
      objects_.emplace_back(shapes_.back());
    }
    for (Object& object : objects_) pointers_.push_back(&object);
  }

  std::vector<std::shared_ptr<BoxShape>> shapes_;
  std::vector<Object> objects_;
  std::vector<Object*> pointers_;
  fcl::DynamicAABBTreeCollisionManagerd manager_;
};

using Pairs = std::vector<std::array<int, 2>>;

class Fcl {
 public:
  Fcl(const onset::Mesh& mesh, Tree tree) : neighbours_{mesh}, tree_(tree) {}

  onset::PairCounts find(const Points& x_t0, const Points& x_t1) {
    make_boxes(neighbours_.mesh, x_t0, x_t1, boxes_);
    vertices_.update(boxes_.vertices, tree_);
    edges_.update(boxes_.edges, tree_);
    faces_.update(boxes_.faces, tree_);
    vertex_face_.clear();
    edge_edge_.clear();
    vertices_.manager().collide(&faces_.manager(), this, [](Object* v, Object* f, void* self) {
      static_cast<Fcl*>(self)->add_vertex_face(id_of(v), id_of(f));
      return false;
    });
    edges_.manager().collide(this, [](Object* a, Object* b, void* self) {
      static_cast<Fcl*>(self)->add_edge_edge(id_of(a), id_of(b));
      return false;
    });
    return {std::int64_t(vertex_face_.size()), std::int64_t(edge_edge_.size())};
  }

 private:
  void add_vertex_face(int v, int f) {
    if (!neighbours_.is_corner(v, f)) vertex_face_.push_back({v, f});
  }
  void add_edge_edge(int a, int b) {
    if (!neighbours_.share_vertex(a, b)) edge_edge_.push_back({a, b});
  }

  Neighbours neighbours_;
  Tree tree_;
  Boxes boxes_;
  Group vertices_, edges_, faces_;
  Pairs vertex_face_, edge_edge_;
};

}  // namespace

Peer fcl_peer(const onset::Mesh& mesh, Tree tree) {
  const auto fcl = std::make_shared<Fcl>(mesh, tree);
  return {tree == Tree::built ? "FCL dynamic AABB tree, built" : "FCL dynamic AABB tree, updated",
          [fcl](const Points& x_t0, const Points& x_t1) { return fcl->find(x_t0, x_t1); }};
}

}  // namespace app
