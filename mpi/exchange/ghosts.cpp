#include "mpi/exchange/ghosts.hpp"

#include <algorithm>
#include <array>
#include <memory>

#include "scene/primitive.hpp"

namespace onset::mpi {
namespace {

// A rank has at least so many boxes of a kind that all others are told of, up to four times as many.
constexpr std::size_t kBoxesForAll = 4;

GhostRules rules_of(const Mesh::Impl& m, std::size_t slot) {
  GhostRules r{};
  if (!m.thickness.empty()) r.thickness = m.thickness[slot];
  if (!m.body.empty()) r.body = m.body[slot];
  if (!m.group.empty()) r.group = m.group[slot], r.mask = m.mask[slot];
  if (!m.is_static.empty()) r.is_static = m.is_static[slot];
  return r;
}

// By kind; null where a call asks about none of these.
using AllOwnBoxes = std::array<std::unique_ptr<OwnBoxes>, 3>;
struct KindBox {
  Box box;
  Primitive kind;
};

// Which kind meets which, of what is owned here and what others have told.
class Meeting {
 public:
  Meeting(const Mesh::Impl& m, const AllOwnBoxes& own, Meetings meetings)
      : m_(m), own_(own), meetings_(meetings) {}

  // Calls f(rank, kind, own boxes of that kind, tree) with the boxes of each rank of what that kind meets.
  template <class F>
  void each(PerRank<KindBox>& theirs, const F& f) const {
    for (std::size_t r = 0; r < theirs.size(); ++r) {
      std::array<std::vector<Box>, 3> boxes;
      for (const KindBox& b : theirs[r]) boxes[std::size_t(b.kind)].push_back(b.box);
      theirs[r] = {};
      for (const Primitive kind : kPrimitives)
        if (const auto partner = partner_of(kind, m_.dimension, meetings_))
          if (std::vector<Box>& of = boxes[std::size_t(*partner)]; !of.empty())
            f(r, kind, *own_[std::size_t(kind)], BoxTree(std::move(of)));
    }
  }

 private:
  const Mesh::Impl& m_;
  const AllOwnBoxes& own_;
  const Meetings meetings_;
};

// (c) Returns a few boxes of each kind of all other ranks, by rank.
PerRank<KindBox> tell_all(const Mesh::Impl& m, const AllOwnBoxes& own) {
  struct RankBox {
    KindBox of;
    int rank;
  };
  std::vector<RankBox> mine;
  m.comm.agreed([&] {
    for (const Primitive kind : kPrimitives)
      if (const auto& boxes = own[std::size_t(kind)])
        for (const Box& box : boxes->tree().cut(kBoxesForAll)) mine.push_back({{box, kind}, m.comm.rank()});
  });
  const std::vector<RankBox> all = m.comm.gather(mine);
  PerRank<KindBox> by_rank;
  m.comm.agreed([&] {
    by_rank.resize(std::size_t(m.comm.size()));
    for (const RankBox& b : all)
      if (b.rank != m.comm.rank()) by_rank[std::size_t(b.rank)].push_back(b.of);
  });
  return by_rank;
}

// (c) Returns the boxes of single primitives of other ranks that may concern this one, by rank: each tells
// the others of its groups that meet their few boxes, then of its primitives that meet their groups.
PerRank<KindBox> exchange_boxes(const Mesh::Impl& m, const AllOwnBoxes& own, const Meeting& meeting) {
  PerRank<KindBox> theirs = tell_all(m, own);
  for (const bool single : {false, true}) {
    PerRank<KindBox> mine;
    m.comm.agreed([&] {
      mine.resize(theirs.size());
      meeting.each(theirs, [&](std::size_t r, Primitive kind, const OwnBoxes& here, const BoxTree& tree) {
        if (single)
          here.each_meeting(tree, [&](int row) { mine[r].push_back({here.box_of(row), kind}); });
        else
          here.tree().each_meeting(tree, [&](std::size_t group) {
            mine[r].push_back({here.tree().leaves()[group], kind});
          });
      });
    });
    theirs = m.comm.exchange(mine);
  }
  return theirs;
}

// Puts primitives into a message, each vertex once.
class Packer {
 public:
  Packer(const Mesh::Impl& m, const OwnMotion& own, Ghosts& out)
      : m_(m), own_(own), out_(out), place_(m.slots()), packed_for_(m.slots(), -1) {}

  // Packs what is owned here of a kind and meets one of `theirs`.
  void pack(const OwnBoxes& own, Primitive kind, const BoxTree& theirs, std::size_t rank) {
    rank_ = rank;
    own.each_meeting(theirs, [&](int row) {
      if (kind == Primitive::vertex) {
        vertex(row);
      } else if (kind == Primitive::edge) {
        const Element<2>& e = m_.own_edges[std::size_t(row)];
        out_.edges[rank].push_back({e.id, {vertex(e.vertices[0]), vertex(e.vertices[1])}});
      } else {
        const Element<3>& f = m_.own_faces[std::size_t(row)];
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

Ghosts exchange_ghosts(const Mesh::Impl& m, const OwnMotion& motion, double inflation, Meetings meetings) {
  Ghosts out, in;
  AllOwnBoxes own;
  m.comm.agreed([&] {
    for (const Primitive kind : kPrimitives)
      if (partner_of(kind, m.dimension, meetings))
        own[std::size_t(kind)] = std::make_unique<OwnBoxes>(m, motion.motion, kind, inflation);
  });
  const Meeting meeting(m, own, meetings);
  PerRank<KindBox> theirs = exchange_boxes(m, own, meeting);
  m.comm.agreed([&] {
    const std::size_t ranks = std::size_t(m.comm.size());
    out.vertices.resize(ranks), out.rules.resize(ranks), out.edges.resize(ranks), out.faces.resize(ranks);
    Packer packer(m, motion, out);
    meeting.each(theirs, [&](std::size_t r, Primitive kind, const OwnBoxes& here, const BoxTree& tree) {
      packer.pack(here, kind, tree, r);
    });
    for (auto& boxes : own) boxes.reset();
  });
  in.vertices = m.comm.exchange(out.vertices);
  if (m.has_rules) in.rules = m.comm.exchange(out.rules);
  in.edges = m.comm.exchange(out.edges);
  in.faces = m.comm.exchange(out.faces);
  return in;
}

}  // namespace onset::mpi
