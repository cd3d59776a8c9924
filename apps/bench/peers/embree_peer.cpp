#include <embree3/rtcore.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <memory>

#include "bench/peers/peer.hpp"

namespace app {
namespace {

float below(double x) {
  const float f = float(x);
  return double(f) > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}
float above(double x) { return -below(-x); }

void bounds(const RTCBoundsFunctionArguments* of) {
  const Box& box = static_cast<const Box*>(of->geometryUserPtr)[of->primID];
  RTCBounds& b = *of->bounds_o;
  b.lower_x = below(box.lo.x()), b.lower_y = below(box.lo.y()), b.lower_z = below(box.lo.z());
  b.upper_x = above(box.hi.x()), b.upper_y = above(box.hi.y()), b.upper_z = above(box.hi.z());
}

bool overlap(const Box& a, const Box& b) {
  return (a.lo.array() <= b.hi.array()).all() && (b.lo.array() <= a.hi.array()).all();
}

// One geometry of boxes in a scene of its own.
class Tree {
 public:
  explicit Tree(RTCDevice device) : device_(device) {}
  Tree(const Tree&) = delete;
  ~Tree() { release(); }

  void build(const std::vector<Box>& boxes) {
    release();
    scene_ = rtcNewScene(device_);
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, unsigned(boxes.size()));
    rtcSetGeometryUserData(geometry, const_cast<Box*>(boxes.data()));
    rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  RTCScene scene() const { return scene_; }

 private:
  void release() {
    if (scene_) rtcReleaseScene(scene_);
    scene_ = nullptr;
  }
  RTCDevice device_;
  RTCScene scene_ = nullptr;
};

// Counts the pairs whose boxes overlap in double: Embree's boxes are wider.
class Embree {
 public:
  explicit Embree(const onset::Mesh& mesh)
      : device_(rtcNewDevice("threads=1,user_threads=1"), rtcReleaseDevice), neighbours_{mesh} {}

  onset::PairCounts find(const Points& x_t0, const Points& x_t1) {
    make_boxes(neighbours_.mesh, x_t0, x_t1, boxes_);
    vertices_.build(boxes_.vertices);
    edges_.build(boxes_.edges);
    faces_.build(boxes_.faces);
    counts_ = {};
    rtcCollide(vertices_.scene(), faces_.scene(), &Embree::count_vertex_face, this);
    rtcCollide(edges_.scene(), edges_.scene(), &Embree::count_edge_edge, this);
    return counts_;
  }

 private:
  static void count_vertex_face(void* self, RTCCollision* collisions, unsigned count) {
    auto& e = *static_cast<Embree*>(self);
    for (unsigned i = 0; i < count; ++i) {
      const int v = int(collisions[i].primID0), f = int(collisions[i].primID1);
      e.counts_.vertex_face += overlap(e.boxes_.vertices[std::size_t(v)], e.boxes_.faces[std::size_t(f)]) &&
                               !e.neighbours_.is_corner(v, f);
    }
  }
  static void count_edge_edge(void* self, RTCCollision* collisions, unsigned count) {
    auto& e = *static_cast<Embree*>(self);
    for (unsigned i = 0; i < count; ++i) {
      const int a = int(collisions[i].primID0), b = int(collisions[i].primID1);
      if (a >= b) continue;  // found in both orders
      e.counts_.edge_edge += overlap(e.boxes_.edges[std::size_t(a)], e.boxes_.edges[std::size_t(b)]) &&
                             !e.neighbours_.share_vertex(a, b);
    }
  }

  std::shared_ptr<RTCDeviceTy> device_;
  Neighbours neighbours_;
  Boxes boxes_;
  Tree vertices_{device_.get()}, edges_{device_.get()}, faces_{device_.get()};
  onset::PairCounts counts_;
};

}  // namespace

Peer embree_peer(const onset::Mesh& mesh) {
  const auto embree = std::make_shared<Embree>(mesh);
  return {"Embree rtcCollide, counted",
          [embree](const Points& x_t0, const Points& x_t1) { return embree->find(x_t0, x_t1); }};
}

}  // namespace app
