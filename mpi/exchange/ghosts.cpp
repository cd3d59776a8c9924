#include "mpi/exchange/ghosts.hpp"

#include <algorithm>
#include <memory>

#include "mpi/exchange/box_groups.hpp"

namespace onset::mpi {
namespace {

// A rank has at least so many boxes that all others are told of, up to four times as many.
constexpr std::size_t kBoxesForAll = 8;

GhostRules rules_of(const Mesh::Impl& m, std::size_t slot) {
  GhostRules r{};
  if (!m.thickness.empty()) r.thickness = m.thickness[slot];
  if (!m.body.empty()) r.body = m.body[slot];
  if (!m.group.empty()) r.group = m.group[slot], r.mask = m.mask[slot];
  if (!m.is_static.empty()) r.is_static = m.is_static[slot];
  return r;
}

// (c) Returns the boxes of other ranks that may concern this one, by rank; those of a rank lie near each
// other in their order.
PerRank<Box> exchange_boxes(const Mesh::Impl& m, const OwnBoxes& own) {
  struct RankBox {
    Box box;
    int rank;
  };
  std::vector<RankBox> mine;
  m.comm.agreed([&] {
    for (const Box& box : own.tree().cut(kBoxesForAll)) mine.push_back({box, m.comm.rank()});
  });
  const std::vector<RankBox> all = m.comm.gather(mine);
  PerRank<Box> finer;
  m.comm.agreed([&] {
    finer.resize(std::size_t(m.comm.size()));
    for (std::size_t first = 0, last; first < all.size(); first = last) {
      std::vector<Box> boxes;
      for (last = first; last < all.size() && all[last].rank == all[first].rank; ++last)
        boxes.push_back(all[last].box);
      if (all[first].rank == m.comm.rank()) continue;
      std::vector<Box>& to = finer[std::size_t(all[first].rank)];
      own.tree().each_meeting(BoxTree(std::move(boxes)),
                              [&](std::size_t group) { to.push_back(own.tree().leaves()[group]); });
    }
  });
  return m.comm.exchange(finer);
}

// Puts primitives into a message, each vertex once.
class Packer {
 public:
  Packer(const Mesh::Impl& m, const OwnMotion& own, Ghosts& out)
      : m_(m), own_(own), out_(out), place_(m.slots()), packed_for_(m.slots(), -1) {}

  void pack(const OwnBoxes& own, const BoxTree& theirs, std::size_t rank) {
    rank_ = rank;
    own.each_meeting(theirs, [&](const OwnBoxes::Item& item) {
      const std::size_t row = std::size_t(item.row);
      if (item.kind == int(Primitive::vertex)) {
        vertex(item.row);
      } else if (item.kind == int(Primitive::edge)) {
        const Element<2>& e = m_.own_edges[row];
        out_.edges[rank].push_back({e.id, {vertex(e.vertices[0]), vertex(e.vertices[1])}});
      } else {
        const Element<3>& f = m_.own_faces[row];
        out_.faces[rank].push_back(
            {f.id, {vertex(f.vertices[0]), vertex(f.vertices[1]), vertex(f.vertices[2])}});
      }
    });
  }

 private:
  int vertex(int slot) {
    const std::size_t s = std::size_t(slot);
    if (packed_for_[s] == int(rank_)) return place_[s];
    packed_for_[s] = int(rank_);
    std::vector<GhostVertex>& vertices = out_.vertices[rank_];
    GhostVertex v{m_.id[s], m_.owner[s], {}};
    std::copy_n(own_.motion.t0(slot), 3, v.x), std::copy_n(own_.end(slot), 3, v.x + 3);
    place_[s] = int(vertices.size());
    vertices.push_back(v);
    if (m_.has_rules) out_.rules[rank_].push_back(rules_of(m_, s));
    return place_[s];
  }

  const Mesh::Impl& m_;
  const OwnMotion& own_;
  Ghosts& out_;
  std::size_t rank_ = 0;
  std::vector<int> place_, packed_for_;  // by slot
};

}  // namespace

Ghosts exchange_ghosts(const Mesh::Impl& m, const OwnMotion& motion, double inflation) {
  Ghosts out, in;
  std::unique_ptr<OwnBoxes> own;
  m.comm.agreed([&] { own = std::make_unique<OwnBoxes>(m, motion.motion, inflation); });
  PerRank<Box> theirs = exchange_boxes(m, *own);
  m.comm.agreed([&] {
    const std::size_t ranks = std::size_t(m.comm.size());
    out.vertices.resize(ranks), out.rules.resize(ranks), out.edges.resize(ranks), out.faces.resize(ranks);
    Packer packer(m, motion, out);
    for (std::size_t r = 0; r < ranks; ++r)
      if (!theirs[r].empty()) packer.pack(*own, BoxTree(std::move(theirs[r])), r);
  });
  in.vertices = m.comm.exchange(out.vertices);
  if (m.has_rules) in.rules = m.comm.exchange(out.rules);
  in.edges = m.comm.exchange(out.edges);
  in.faces = m.comm.exchange(out.faces);
  return in;
}

}  // namespace onset::mpi
