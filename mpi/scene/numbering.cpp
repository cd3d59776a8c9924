#include "mpi/scene/numbering.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "mpi/messages/directory.hpp"

namespace onset::mpi {
namespace {

using Edge = std::array<int, 2>;  // the larger id first, so that they sort as onset::edges orders them

std::vector<Edge> edges_of(const std::vector<Element<3>>& faces) {
  std::vector<Edge> edges;
  edges.reserve(3 * faces.size());
  for (const Element<3>& f : faces)
    for (std::size_t c = 0; c < 3; ++c) {
      const int v = f.vertices[c], w = f.vertices[(c + 1) % 3];
      edges.push_back({std::max(v, w), std::min(v, w)});
    }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

PerRank<Edge> by_directory(const Communicator& comm, const Directory& directory,
                           const std::vector<Edge>& edges) {
  PerRank<Edge> out(std::size_t(comm.size()));
  for (const Edge& e : edges) out[directory.rank_of(e[0])].push_back(e);
  return out;
}

PerRank<int> by_directory(const Communicator& comm, const Directory& directory, const std::vector<int>& ids,
                          std::int64_t vertices) {
  PerRank<int> out(std::size_t(comm.size()));
  for (const int id : ids) {
    if (id < 0 || id >= vertices)
      throw std::invalid_argument("vertex id " + std::to_string(id) + " is out of range, the ranks own " +
                                  std::to_string(vertices) +
                                  " vertices, with ids from 0 on (is there one that no rank owns?)");
    out[directory.rank_of(id)].push_back(id);
  }
  return out;
}

// The answers to what each rank asked, put back in the order of the questions, which went to ranks in
// ascending order of ids.
template <class Answer, class Question, class RankOf, class Take>
void take_answers(const std::vector<Question>& questions, const PerRank<Answer>& answers,
                  const RankOf& rank_of, const Take& take) {
  std::vector<std::size_t> next(answers.size());
  for (const Question& q : questions) {
    const std::size_t r = rank_of(q);
    take(q, answers[r][next[r]++]);
  }
}

}  // namespace

VertexOwners::VertexOwners(const Communicator& comm, const std::vector<int>& owned) : comm_(comm) {
  count_ = std::int64_t(owned.size());
  comm.sum(&count_, 1);
  const Directory directory(comm, count_);
  PerRank<int> out;
  comm.agreed([&] {
    if (count_ > std::numeric_limits<int>::max())
      throw std::invalid_argument("there are more than 2^31 - 1 vertices");
    out = by_directory(comm, directory, owned, count_);
  });
  const PerRank<int> in = comm.exchange(out);
  comm.agreed([&] {
    owner_.assign(directory.size(), -1);
    for (std::size_t r = 0; r < in.size(); ++r)
      for (const int id : in[r]) {
        int& owner = owner_[directory.place(id)];
        if (owner >= 0)
          throw std::invalid_argument("vertex id " + std::to_string(id) + " is owned by rank " +
                                      std::to_string(owner) + " and again by rank " + std::to_string(r));
        owner = int(r);
      }
  });
}

std::vector<int> VertexOwners::of(const std::vector<int>& ids) const {
  const Directory directory(comm_, count_);
  PerRank<int> out;
  comm_.agreed([&] { out = by_directory(comm_, directory, ids, count_); });
  PerRank<int> asked = comm_.exchange(out);
  for (std::vector<int>& of_rank : asked)
    for (int& id : of_rank) id = owner_[directory.place(id)];
  const PerRank<int> answers = comm_.exchange(asked);
  std::vector<int> owners;
  comm_.agreed([&] {
    owners.reserve(ids.size());
    take_answers(
        ids, answers, [&](int id) { return directory.rank_of(id); },
        [&](int, int owner) { owners.push_back(owner); });
  });
  return owners;
}

template <std::size_t N>
std::int64_t keep_owned(const Communicator& comm, const char* what, std::vector<Element<N>>& elements) {
  std::int64_t count = 0;
  for (const Element<N>& e : elements) count = std::max(count, std::int64_t(e.id) + 1);
  comm.maximum(&count, 1);
  std::int64_t given = std::int64_t(elements.size());
  comm.sum(&given, 1);
  if (count > given)  // before anything is made that is as large as the largest id
    throw std::invalid_argument(std::string(what) + " id " + std::to_string(count - 1) +
                                " is given, but the ranks give only " + std::to_string(given) +
                                " rows together, and ids have no gaps");
  const Directory directory(comm, count);
  PerRank<Element<N>> out;
  const auto row = [&](int id) { return std::string(what) + " id " + std::to_string(id); };
  comm.agreed([&] {
    std::sort(elements.begin(), elements.end(), [](const auto& e, const auto& f) { return e.id < f.id; });
    out.resize(std::size_t(comm.size()));
    for (std::size_t i = 0; i < elements.size(); ++i) {
      if (elements[i].id < 0) throw std::invalid_argument(row(elements[i].id) + " is below 0");
      if (i > 0 && elements[i].id == elements[i - 1].id)
        throw std::invalid_argument(row(elements[i].id) + " is given twice");
      out[directory.rank_of(elements[i].id)].push_back(elements[i]);
    }
  });
  const PerRank<Element<N>> in = comm.exchange(out);
  PerRank<char> is_owner;
  comm.agreed([&] {
    is_owner.resize(in.size());
    std::vector<const Element<N>*> first(directory.size());
    for (std::size_t r = 0; r < in.size(); ++r)
      for (const Element<N>& e : in[r]) {
        const Element<N>*& known = first[directory.place(e.id)];
        is_owner[r].push_back(known == nullptr);
        if (known == nullptr) known = &e;
        if (known->vertices != e.vertices)
          throw std::invalid_argument(row(e.id) + " has other vertices, or another order of them, on rank " +
                                      std::to_string(r) + " than on a lower one");
      }
    for (std::size_t i = 0; i < first.size(); ++i)
      if (first[i] == nullptr)
        throw std::invalid_argument("no rank gives " + row(int(directory.first() + std::int64_t(i))));
  });
  const PerRank<char> answers = comm.exchange(is_owner);
  comm.agreed([&] {
    std::vector<Element<N>> owned;
    take_answers(
        elements, answers, [&](const auto& e) { return directory.rank_of(e.id); },
        [&](const auto& e, char mine) {
          if (mine) owned.push_back(e);
        });
    elements = std::move(owned);
  });
  return count;
}
template std::int64_t keep_owned(const Communicator&, const char*, std::vector<Element<2>>&);
template std::int64_t keep_owned(const Communicator&, const char*, std::vector<Element<3>>&);

std::int64_t edges_of_faces(const Communicator& comm, std::int64_t vertices,
                            const std::vector<Element<3>>& faces, std::vector<Element<2>>& edges) {
  const Directory directory(comm, vertices);
  std::vector<Edge> mine;
  PerRank<Edge> out;
  comm.agreed([&] {
    mine = edges_of(faces);
    out = by_directory(comm, directory, mine);
  });
  const PerRank<Edge> in = comm.exchange(out);
  std::vector<Edge> kept;
  comm.agreed([&] {
    for (const std::vector<Edge>& of_rank : in) kept.insert(kept.end(), of_rank.begin(), of_rank.end());
    std::sort(kept.begin(), kept.end());
    kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  });
  const std::int64_t first = comm.sum_before(std::int64_t(kept.size()));
  std::int64_t count = std::int64_t(kept.size());
  comm.sum(&count, 1);
  PerRank<int> ids;  // -1: a lower rank owns it
  comm.agreed([&] {
    if (count > std::int64_t(1) << 31) throw std::invalid_argument("there are more than 2^31 edges");
    ids.resize(in.size());
    std::vector<char> owned(kept.size());
    for (std::size_t r = 0; r < in.size(); ++r)
      for (const Edge& e : in[r]) {
        const std::size_t place = std::size_t(std::lower_bound(kept.begin(), kept.end(), e) - kept.begin());
        ids[r].push_back(owned[place] ? -1 : int(first + std::int64_t(place)));
        owned[place] = 1;
      }
  });
  const PerRank<int> answers = comm.exchange(ids);
  comm.agreed([&] {
    edges.clear();
    take_answers(
        mine, answers, [&](const Edge& e) { return directory.rank_of(e[0]); },
        [&](const Edge& e, int id) {
          if (id >= 0) edges.push_back({id, {e[1], e[0]}});
        });
  });
  return count;
}

void require_edges(const Communicator& comm, std::int64_t vertices, const std::vector<Element<3>>& faces,
                   const std::vector<Element<2>>& edges) {
  const Directory directory(comm, vertices);
  PerRank<Edge> wanted, given;
  comm.agreed([&] {
    wanted = by_directory(comm, directory, edges_of(faces));
    std::vector<Edge> upward;
    for (const auto& e : edges)
      upward.push_back({std::max(e.vertices[0], e.vertices[1]), std::min(e.vertices[0], e.vertices[1])});
    given = by_directory(comm, directory, upward);
  });
  wanted = comm.exchange(wanted);
  given = comm.exchange(given);
  comm.agreed([&] {
    std::vector<Edge> all;
    for (const std::vector<Edge>& of_rank : given) all.insert(all.end(), of_rank.begin(), of_rank.end());
    std::sort(all.begin(), all.end());
    for (const std::vector<Edge>& of_rank : wanted)
      for (const Edge& e : of_rank)
        if (!std::binary_search(all.begin(), all.end(), e))
          throw std::invalid_argument("a face has an edge between vertices " + std::to_string(e[1]) +
                                      " and " + std::to_string(e[0]) +
                                      ", which is not among the edges; give no edges "
                                      "to have those of the faces");
  });
}

void require_lone_points(const Communicator& comm, std::int64_t vertices,
                         const std::vector<Element<2>>& points, const std::vector<Element<2>>& edges,
                         const std::vector<Element<3>>& faces) {
  std::int64_t count = std::int64_t(points.size());
  comm.sum(&count, 1);
  if (count == 0) return;
  const Directory directory(comm, vertices);
  PerRank<int> in_elements, of_points;
  comm.agreed([&] {
    const auto vertices_of = [](const auto&... lists) {
      std::vector<int> ids;
      const auto add = [&](const auto& list) {
        for (const auto& e : list) ids.insert(ids.end(), e.vertices.begin(), e.vertices.end());
      };
      (add(lists), ...);
      std::sort(ids.begin(), ids.end());
      ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
      return ids;
    };
    in_elements = by_directory(comm, directory, vertices_of(edges, faces), vertices);
    std::vector<int> alone;
    for (const Element<2>& p : points) alone.push_back(p.vertices[0]);
    of_points = by_directory(comm, directory, alone, vertices);
  });
  in_elements = comm.exchange(in_elements);
  of_points = comm.exchange(of_points);
  comm.agreed([&] {
    enum : char { none, element, point };
    std::vector<char> used(directory.size(), none);
    for (const std::vector<int>& ids : in_elements)
      for (const int v : ids) used[directory.place(v)] = element;
    for (const std::vector<int>& ids : of_points)
      for (const int v : ids) {
        char& by = used[directory.place(v)];
        if (by != none)
          throw std::invalid_argument("points: vertex " + std::to_string(v) +
                                      (by == element ? " belongs to an edge or a face" : " is repeated"));
        by = point;
      }
  });
}

}  // namespace onset::mpi
