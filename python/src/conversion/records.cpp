#include "conversion/records.hpp"

#include <nanobind/stl/string.h>

#include <stdexcept>
#include <string>

namespace onset_python {
namespace {

template <class M>
struct Format;
template <>
struct Format<double> {
  static constexpr const char* name = "f8";
};
template <>
struct Format<int> {
  static constexpr const char* name = "i4";
};
template <>
struct Format<bool> {
  static constexpr const char* name = "?";
};

// Fields of a record, found out from one of them in memory.
class Layout {
 public:
  explicit Layout(const void* record) : record_(static_cast<const char*>(record)) {}
  template <class M>
  Layout& add(const char* name, const M& member) {
    if constexpr (std::is_enum_v<M>) {
      static_assert(sizeof(M) == 1);
      put(name, nb::str("u1"), &member);
    } else {
      put(name, nb::str(Format<M>::name), &member);
    }
    return *this;
  }
  template <class M, std::size_t N>
  Layout& add(const char* name, const std::array<M, N>& member) {
    put(name, nb::make_tuple(nb::str(Format<M>::name), nb::make_tuple(N)), &member);
    return *this;
  }
  nb::object dtype(std::size_t size) const {
    nb::dict all;
    all["names"] = names_, all["formats"] = formats_, all["offsets"] = offsets_, all["itemsize"] = size;
    return nb::module_::import_("numpy").attr("dtype")(all);
  }

 private:
  void put(const char* name, nb::object format, const void* member) {
    names_.append(nb::str(name)), formats_.append(format);
    offsets_.append(static_cast<const char*>(member) - record_);
  }
  const char* record_;
  nb::list names_, formats_, offsets_;
};

Layout layout_of_pair(const void* record, const onset::Pair& p) {
  Layout l(record);
  l.add("kind", p.kind).add("a", p.a).add("b", p.b).add("vertices", p.vertices);
  return l;
}

// Made once a process, and never freed: modules are not unloaded.
template <class Make>
nb::object made_once(nb::object*& place, Make&& make) {
  if (place == nullptr) place = new nb::object(make());
  return *place;
}

nb::object field(const char* name, nb::handle values, const char* field) {
  const nb::object names = nb::getattr(nb::getattr(values, "dtype", nb::none()), "names", nb::none());
  if (names.is_none() || !nb::cast<bool>(names.attr("__contains__")(field)))
    throw std::invalid_argument(std::string(name) + " must be a structured array with a field '" + field +
                                "'");
  return values[field];
}

}  // namespace

nb::object dtype_of(const onset::Pair& p) {
  static nb::object* made = nullptr;
  return made_once(made, [&] { return layout_of_pair(&p, p).dtype(sizeof p); });
}

nb::object dtype_of(const onset::Contact& c) {
  static nb::object* made = nullptr;
  return made_once(made, [&] {
    return layout_of_pair(&c, c)
        .add("toi", c.toi)
        .add("toi_hi", c.toi_hi)
        .add("step_limit", c.step_limit)
        .add("tolerance", c.tolerance)
        .add("outcome", c.outcome)
        .add("certainty", c.certainty)
        .add("degenerate", c.degenerate)
        .add("weights", c.weights)
        .add("normal", c.normal)
        .add("gap", c.gap)
        .add("speed", c.speed)
        .dtype(sizeof c);
  });
}

nb::object dtype_of(const onset::ClosePair& p) {
  static nb::object* made = nullptr;
  return made_once(made, [&] {
    return layout_of_pair(&p, p)
        .add("weights", p.weights)
        .add("distance", p.distance)
        .add("separation", p.separation)
        .add("gap", p.gap)
        .dtype(sizeof p);
  });
}

nb::object dtype_of(const onset::Intersection& p) {
  static nb::object* made = nullptr;
  return made_once(made, [&] {
    return Layout(&p)
        .add("edge", p.edge)
        .add("face", p.face)
        .add("kind", p.kind)
        .add("vertices", p.vertices)
        .dtype(sizeof p);
  });
}

std::vector<onset::Pair> pairs_of(const char* name, nb::handle values) {
  std::vector<onset::Pair> list;
  if (values.is_none()) return list;
  if (!nb::hasattr(values, "dtype")) {
    for (const nb::handle value : values) {
      onset::Pair p;
      if (!nb::try_cast(value, p)) throw nb::type_error((std::string(name) + " must be pairs").c_str());
      list.push_back(p);
    }
    return list;
  }
  const std::vector<int> kinds = ids(name, field(name, values, "kind")),
                         a = ids(name, field(name, values, "a")), b = ids(name, field(name, values, "b"));
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    if (kinds[i] < 0 || kinds[i] > int(onset::PairKind::vertex_plane))
      throw std::invalid_argument(std::string(name) + " row " + std::to_string(i) +
                                  ": there is no such kind of pair");
    list.push_back({onset::PairKind(kinds[i]), a[i], b[i], {}});
  }
  return list;
}

std::vector<onset::Intersection> intersections_of(const char* name, nb::handle values) {
  std::vector<onset::Intersection> list;
  if (values.is_none()) return list;
  const std::vector<int> edges = ids(name, field(name, values, "edge")),
                         faces = ids(name, field(name, values, "face"));
  for (std::size_t i = 0; i < edges.size(); ++i) {
    onset::Intersection p;
    p.edge = edges[i], p.face = faces[i];
    list.push_back(p);
  }
  return list;
}

}  // namespace onset_python
