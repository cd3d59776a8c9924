#include "onset/mpi/mesh.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <new>
#include <numeric>
#include <stdexcept>
#include <string>

#include "base/float_environment.hpp"
#include "mpi/scene/mesh_impl.hpp"
#include "mpi/scene/part_rules.hpp"
#include "mpi/scene/rings.hpp"
#include "onset/mesh.hpp"

namespace onset::mpi {
namespace {

[[noreturn]] void reject(const std::string& why) { throw std::invalid_argument(why); }

void check_ids(const char* what, std::size_t ids, std::ptrdiff_t rows) {
  if (std::ptrdiff_t(ids) != rows)
    reject(std::string(what) + " has " + std::to_string(ids) + " ids for " + std::to_string(rows) + " rows");
}

// Elements by the ids of their vertices.
template <std::size_t N>
std::vector<Element<N>> elements(const char* what, const Indices& rows, const std::vector<int>& ids,
                                 const std::vector<int>& vertex_ids) {
  if (rows.rows() > 0 && rows.cols() != std::ptrdiff_t(N))
    reject(std::string(what) + "s have " + std::to_string(rows.cols()) + " columns, not " +
           std::to_string(N));
  std::vector<Element<N>> all;
  for (std::ptrdiff_t r = 0; r < rows.rows(); ++r) {
    Element<N> e{ids[std::size_t(r)], {}};
    for (std::size_t c = 0; c < N; ++c) {
      const long long v = rows(r, std::ptrdiff_t(c));
      const std::string where =
          std::string(what) + " row " + std::to_string(r) + ": vertex row " + std::to_string(v);
      if (v < 0 || v >= std::ptrdiff_t(vertex_ids.size()))
        reject(where + " is out of range, there are " + std::to_string(vertex_ids.size()));
      e.vertices[c] = vertex_ids[std::size_t(v)];
      for (std::size_t k = 0; k < c; ++k)
        if (e.vertices[k] == e.vertices[c]) reject(where + " is repeated");
    }
    all.push_back(e);
  }
  return all;
}

void check_part(const MeshPart& part) {
  if (part.owned < 0 || part.owned > std::ptrdiff_t(part.vertex_ids.size()))
    reject("owned is " + std::to_string(part.owned) + ", and there are " +
           std::to_string(part.vertex_ids.size()) + " rows");
  check_ids("face_ids", part.face_ids.size(), part.faces.rows());
  check_ids("edge_ids", part.edge_ids.size(), part.edges.rows());
  check_ids("point_ids", part.point_ids.size(), std::ptrdiff_t(part.rules.points.size()));
  if (part.dimension != 2 && part.dimension != 3)
    reject("dimension is " + std::to_string(part.dimension) + "; it must be 3 or 2");
  if (part.dimension == 2 && part.faces.rows() > 0) reject("a mesh in the plane has no faces");
  if (part.rules.rest_positions.size() > 0) reject("rest_positions is not offered over ranks");
}

void check_vertex_ids(const std::vector<int>& ids, std::int64_t vertices) {
  for (std::size_t r = 0; r < ids.size(); ++r)
    if (ids[r] < 0 || ids[r] >= vertices)
      reject("vertex_ids row " + std::to_string(r) + ": " + std::to_string(ids[r]) +
             " is out of range, the ranks own " + std::to_string(vertices) +
             " vertices, with ids from 0 on (is there one that no rank owns?)");
}

std::vector<Element<2>> points_of(const MeshPart& part) {
  std::vector<Element<2>> points;
  for (std::size_t r = 0; r < part.rules.points.size(); ++r) {
    const int row = part.rules.points[r];
    if (row < 0 || std::size_t(row) >= part.vertex_ids.size())
      reject("points row " + std::to_string(r) + ": vertex row " + std::to_string(row) + " is out of range");
    const int v = part.vertex_ids[std::size_t(row)];
    points.push_back({part.point_ids[r], {v, v}});
  }
  return points;
}

// (c) Finds the elements of the scene and which are owned here, by ids of vertices.
void find_elements(const MeshPart& part, Mesh::Impl& m) {
  const Communicator& comm = m.comm;
  std::vector<Element<3>> faces;
  std::vector<Element<2>> edges, points;
  comm.agreed([&] {
    check_vertex_ids(part.vertex_ids, m.vertices);
    faces = elements<3>("face", part.faces, part.face_ids, part.vertex_ids);
    edges = elements<2>("edge", part.edges, part.edge_ids, part.vertex_ids);
    points = points_of(part);
  });
  std::int64_t given = std::int64_t(edges.size());
  comm.sum(&given, 1);
  if (given > 0) {
    require_edges(comm, m.vertices, faces, edges);
    m.edges = keep_owned(comm, "edge", edges);
  } else {
    m.edges = edges_of_faces(comm, m.vertices, faces, edges);
  }
  m.faces = keep_owned(comm, "face", faces);
  m.points = keep_owned(comm, "point", points);
  require_lone_points(comm, m.vertices, points, edges, faces);
  comm.agreed([&] {
    if (m.edges + m.points > std::numeric_limits<int>::max()) reject("there are more than 2^31 - 1 edges");
    for (Element<2>& p : points) p.id += int(m.edges);
    edges.insert(edges.end(), points.begin(), points.end());
  });
  m.edges += m.points;
  m.own_edges = std::move(edges), m.own_faces = std::move(faces);
  comm.agreed([&] { m.own_edges.shrink_to_fit(), m.own_faces.shrink_to_fit(); });
}

// (c) Makes slots of all vertices that are owned, or are of elements that are, and turns ids into slots.
void find_slots(const MeshPart& part, const VertexOwners& owners, Mesh::Impl& m) {
  const Communicator& comm = m.comm;
  std::vector<int> wanted, owned;
  std::vector<std::pair<int, int>> slot_of;
  const auto slot = [&](int id) {
    const auto at = std::lower_bound(slot_of.begin(), slot_of.end(), std::pair(id, 0));
    return at != slot_of.end() && at->first == id ? at->second : -1;
  };
  comm.agreed([&] {
    owned.assign(part.vertex_ids.begin(), part.vertex_ids.begin() + part.owned);
    for (std::size_t i = 0; i < owned.size(); ++i) slot_of.push_back({owned[i], int(i)});
    std::sort(slot_of.begin(), slot_of.end());
    const auto want = [&](const auto& all) {
      for (const auto& e : all)
        for (const int v : e.vertices)
          if (slot(v) < 0) wanted.push_back(v);
    };
    want(m.own_edges), want(m.own_faces);
    std::sort(wanted.begin(), wanted.end());
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  });
  const std::vector<int> halo_owners = owners.of(wanted);
  m.halo = Halo(comm, owned, wanted, halo_owners);
  comm.agreed([&] {
    m.id.reserve(owned.size() + wanted.size()), m.owner.reserve(owned.size() + wanted.size());
    m.id = owned;
    m.owner.assign(owned.size(), comm.rank());
    m.id.insert(m.id.end(), wanted.begin(), wanted.end());
    m.owner.insert(m.owner.end(), halo_owners.begin(), halo_owners.end());
    for (std::size_t i = 0; i < wanted.size(); ++i) slot_of.push_back({wanted[i], int(owned.size() + i)});
    std::sort(slot_of.begin(), slot_of.end());
    m.by_id.reserve(slot_of.size());
    for (const auto& [id, place] : slot_of) m.by_id.push_back(place);
    for (Element<2>& e : m.own_edges)
      for (int& v : e.vertices) v = slot(v);
    for (Element<3>& f : m.own_faces)
      for (int& v : f.vertices) v = slot(v);
  });
}

// (c) A rank without memory for it tells the others, who would wait for it in the duplication.
template <class Impl>
std::unique_ptr<Impl> make_impl(MPI_Comm comm) {
  std::unique_ptr<Impl> impl;
  try {
    impl = std::make_unique<Impl>();
  } catch (const std::bad_alloc&) {
  }
  int made = impl != nullptr;
  MPI_Allreduce(MPI_IN_PLACE, &made, 1, MPI_INT, MPI_MIN, comm);
  if (!made) throw std::bad_alloc();
  impl->comm.duplicate(comm);
  return impl;
}

}  // namespace

Mesh::Mesh(MPI_Comm comm, const MeshPart& part) : impl_(make_impl<Impl>(comm)) {
  Impl& m = *impl_;
  const FloatEnvironment environment;
  std::vector<int> owned;
  m.comm.agreed([&] {
    onset::Mesh();  // what it sets up once a process is not to fail between messages
    check_part(part);
    owned.assign(part.vertex_ids.begin(), part.vertex_ids.begin() + part.owned);
  });
  m.comm.require_same({{"dimension", std::uint64_t(part.dimension)}});
  m.dimension = part.dimension;
  m.rows = std::ptrdiff_t(part.vertex_ids.size()), m.owned = part.owned;
  const VertexOwners owners(m.comm, owned);
  m.vertices = owners.count();
  find_elements(part, m);
  find_slots(part, owners, m);
  take_rules(part, m);
  find_rings(owners, part.rules.excluded_rings, m);
  find_partners(m);
  choose_samples(m);
}

Mesh::~Mesh() = default;
Mesh::Mesh(Mesh&&) noexcept = default;
Mesh& Mesh::operator=(Mesh&&) noexcept = default;

int Mesh::rank() const noexcept { return impl_->comm.rank(); }
int Mesh::size() const noexcept { return impl_->comm.size(); }
int Mesh::dimension() const noexcept { return impl_->dimension; }
std::int64_t Mesh::num_vertices() const noexcept { return impl_->vertices; }
std::int64_t Mesh::num_edges() const noexcept { return impl_->edges; }
std::int64_t Mesh::num_faces() const noexcept { return impl_->faces; }
std::ptrdiff_t Mesh::rows() const noexcept { return impl_->rows; }
std::ptrdiff_t Mesh::owned() const noexcept { return impl_->owned; }
const Exchange& Mesh::exchange() const noexcept { return impl_->exchange; }

}  // namespace onset::mpi
