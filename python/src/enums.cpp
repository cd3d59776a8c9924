// The enumerations, with the names that they have in C++.
#include <onset/check.hpp>
#include <onset/options.hpp>
#include <onset/result.hpp>
#include <string>

#include "bindings.hpp"

namespace onset_python {
namespace {

using namespace onset;

template <class E>
class Enumeration {
 public:
  Enumeration(nb::module_& m, const char* name, const char* what = nullptr)
      : name_(name), type_(m, name, nb::is_arithmetic(), what != nullptr ? what : doc(name)) {}
  Enumeration& add(const char* name, E value) {
    type_.value(name, value, doc((std::string(name_) + "." + name).c_str()));
    return *this;
  }

 private:
  const char* name_;
  nb::enum_<E> type_;
};

void bind_what_is_known(nb::module_& m) {
  Enumeration<PairKind>(m, "PairKind")
      .add("vertex_face", PairKind::vertex_face)
      .add("edge_edge", PairKind::edge_edge)
      .add("vertex_edge", PairKind::vertex_edge)
      .add("vertex_plane", PairKind::vertex_plane);
  Enumeration<Certainty>(m, "Certainty")
      .add("within_tolerance", Certainty::within_tolerance)
      .add("certain", Certainty::certain)
      .add("touching_at_start", Certainty::touching_at_start);
  Enumeration<IntersectionKind>(m, "IntersectionKind")
      .add("crossing", IntersectionKind::crossing)
      .add("touching", IntersectionKind::touching)
      .add("overlapping", IntersectionKind::overlapping);
  Enumeration<StartFault>(m, "StartFault", "What may be wrong with a start.")
      .add("intersecting", StartFault::intersecting)
      .add("touching", StartFault::touching)
      .add("within_separation", StartFault::within_separation)
      .add("copied_vertices", StartFault::copied_vertices)
      .add("faces_without_area", StartFault::faces_without_area)
      .add("unused_vertices", StartFault::unused_vertices);
}

void bind_outcomes(nb::module_& m) {
  Enumeration<PairOutcome>(m, "PairOutcome")
      .add("free", PairOutcome::free)
      .add("contact", PairOutcome::contact)
      .add("initial_contact", PairOutcome::initial_contact)
      .add("initial_separating", PairOutcome::initial_separating)
      .add("max_checks", PairOutcome::max_checks)
      .add("below_rounding", PairOutcome::below_rounding)
      .add("non_finite", PairOutcome::non_finite)
      .add("out_of_range", PairOutcome::out_of_range);
  Enumeration<Outcome>(m, "Outcome")
      .add("free", Outcome::free)
      .add("contact", Outcome::contact)
      .add("initial_contact", Outcome::initial_contact)
      .add("max_checks", Outcome::max_checks)
      .add("below_rounding", Outcome::below_rounding)
      .add("non_finite", Outcome::non_finite)
      .add("out_of_range", Outcome::out_of_range)
      .add("out_of_time", Outcome::out_of_time)
      .add("out_of_memory", Outcome::out_of_memory)
      .add("out_of_checks", Outcome::out_of_checks)
      .add("cancelled", Outcome::cancelled);
}

void bind_choices(nb::module_& m) {
  Enumeration<Norm>(m, "Norm").add("euclidean", Norm::euclidean).add("maximum", Norm::maximum);
  Enumeration<BroadPhaseMethod>(m, "BroadPhaseMethod")
      .add("automatic", BroadPhaseMethod::automatic)
      .add("bvh", BroadPhaseMethod::bvh)
      .add("hash", BroadPhaseMethod::hash)
      .add("brute", BroadPhaseMethod::brute);
  Enumeration<NarrowPhaseMethod>(m, "NarrowPhaseMethod")
      .add("automatic", NarrowPhaseMethod::automatic)
      .add("inclusion", NarrowPhaseMethod::inclusion);
  Enumeration<InstructionSet>(m, "InstructionSet")
      .add("automatic", InstructionSet::automatic)
      .add("scalar", InstructionSet::scalar)
      .add("avx2", InstructionSet::avx2)
      .add("avx512", InstructionSet::avx512);
  Enumeration<Exactness>(m, "Exactness")
      .add("conservative", Exactness::conservative)
      .add("certify", Exactness::certify)
      .add("exact", Exactness::exact);
}

}  // namespace

void bind_enums(nb::module_& m) {
  bind_what_is_known(m);
  bind_outcomes(m);
  bind_choices(m);
}

}  // namespace onset_python
