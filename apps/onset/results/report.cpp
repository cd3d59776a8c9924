#include "onset/results/report.hpp"

#include <cmath>

#include "files/queries/query_kind.hpp"

namespace app {

const char* norm_name(onset::Norm norm) { return norm == onset::Norm::maximum ? "maximum" : "euclidean"; }

const char* exactness_name(onset::Exactness level) {
  return level == onset::Exactness::exact     ? "exact"
         : level == onset::Exactness::certify ? "certify"
                                              : "conservative";
}

Json to_json(const onset::PairCounts& counts) {
  Json json = {{"vf", counts.vertex_face}, {"ee", counts.edge_edge}};
  if (counts.vertex_edge > 0) json["ve"] = counts.vertex_edge;
  if (counts.vertex_plane > 0) json["vp"] = counts.vertex_plane;
  return json;
}

const char* outcome_name(onset::Outcome outcome) {
  return outcome == onset::Outcome::max_checks ? "budget" : onset::to_string(outcome);
}
const char* outcome_name(onset::PairOutcome outcome) {
  return outcome == onset::PairOutcome::max_checks ? "budget" : onset::to_string(outcome);
}

Json to_json(const onset::Pair& pair) {
  return {{"kind", kind_name(pair.kind)}, {"a", pair.a}, {"b", pair.b}, {"vertices", pair.vertices}};
}
Json to_json(const std::optional<onset::Pair>& pair) { return pair ? to_json(*pair) : Json(); }

namespace {

Json kind_json(const onset::PairFilterCounts& p) {
  return {{"needed", p.may_meet() > 0},
          {"pairs", p.pairs},
          {"may_meet", p.may_meet()},
          {"left_out",
           {{"masked", p.masked},
            {"static", p.both_static},
            {"same_body", p.same_body},
            {"adjacent", p.adjacent},
            {"excluded", p.excluded},
            {"within_rings", p.within_rings}}}};
}

Json primitive_json(const onset::PrimitiveFilterCounts& p) {
  return {{"moving", p.moving}, {"static", p.statics}, {"dropped", p.dropped}};
}

}  // namespace

Json to_json(const onset::FilterCounts& p) {
  Json json = {{"vf", kind_json(p.vertex_face)},
               {"ee", kind_json(p.edge_edge)},
               {"vertices", primitive_json(p.vertices)},
               {"edges", primitive_json(p.edges)},
               {"faces", primitive_json(p.faces)}};
  if (p.vertex_edge.pairs > 0) json["ve"] = kind_json(p.vertex_edge);
  return json;
}

Json to_json(const onset::Stats& s) {
  return {{"swept", to_json(s.swept)},
          {"candidates", to_json(s.candidates)},
          {"contacts", to_json(s.contacts)},
          {"after_culls", to_json(s.after_culls)},
          {"inclusion", to_json(s.inclusion)},
          {"budget", to_json(s.gave_up)},
          {"checks", s.checks},
          {"max_checks_of_a_pair", s.max_checks_of_a_pair},
          {"checks_histogram", s.checks_histogram},
          {"worst", to_json(s.worst)},
          {"looked_at", s.looked_at},
          {"seconds_contacts", s.seconds_contacts},
          {"achieved_tolerance", s.achieved_tolerance},
          {"extent", s.extent},
          {"error_bound", s.error_bound},
          {"plan", to_json(s.filter_counts)},
          {"made_fixed_boxes", s.made_static_boxes},
          {"threads", s.threads},
          {"kernel", s.instruction_set},
          {"broad_phase", s.broad_phase}};
}

Json seconds_json(const onset::Stats& s) {
  return {{"broad", s.seconds_broad}, {"narrow", s.seconds_narrow}, {"total", s.seconds_total}};
}

Json spread_json(const Spread& s) { return {{"median", s.median}, {"min", s.least}, {"max", s.most}}; }

Json time_json(double time) { return std::isfinite(time) ? Json(time) : Json(); }

// toi_hi is null where no contact is certain by any time.
static void add_certainty(Json& json, onset::Certainty certainty, double toi_hi) {
  json["certainty"] = onset::to_string(certainty);
  json["toi_hi"] = time_json(toi_hi);
}

Json step_json(const onset::StepResult& r) {
  Json json = {{"outcome", outcome_name(r.outcome)},
               {"step", r.step},
               {"limiting", to_json(r.limiting)},
               {"candidates", to_json(r.stats.candidates)},
               {"seconds", seconds_json(r.stats)},
               {"tolerance", r.stats.tolerance},
               {"toi", time_json(r.toi)},
               {"rounding", r.rounding},
               {"shortest", r.shortest}};
  if (r.limiting) add_certainty(json["limiting"], r.certainty, r.toi_hi);
  if (r.vertex >= 0) json["vertex"] = r.vertex;
  json["stats"] = to_json(r.stats);
  return json;
}

Json active_set_json(const onset::ActiveSet& set) {
  const onset::Contact* first = set.earliest();
  Json pair = nullptr;
  if (first != nullptr) {
    pair = to_json(static_cast<const onset::Pair&>(*first));
    pair["toi"] = first->toi;
    pair["status"] = outcome_name(first->outcome);
    add_certainty(pair, first->certainty, first->toi_hi);
  }
  Json json = {{"contacts", to_json(set.stats.contacts)},
               {"earliest", first == nullptr ? Json() : Json(first->toi)},
               {"candidates", to_json(set.stats.candidates)},
               {"seconds", seconds_json(set.stats)},
               {"earliest_pair", pair},
               {"outcome", outcome_name(set.outcome)},
               {"tolerance", set.stats.tolerance}};
  if (set.vertex >= 0) json["vertex"] = set.vertex;
  json["complete_until"] = std::isinf(set.complete_until) ? Json() : Json(set.complete_until);
  json["stats"] = to_json(set.stats);
  return json;
}

void write_active_set_csv(Output& csv, const onset::ActiveSet& set) {
  csv.write(std::string(kActiveSetColumns) + "\n");
  for (const onset::Contact& c : set) {
    const auto& v = c.vertices;
    csv.write(format("%s,%d,%d,%.17g,%d,%d,%d,%d,%s,%s,%.17g", kind_name(c.kind), c.a, c.b, c.toi, v[0], v[1],
                     v[2], v[3], outcome_name(c.outcome), onset::to_string(c.certainty), c.toi_hi));
    const auto& w = c.weights;
    const auto& n = c.normal;
    for (const double x : {w[0], w[1], w[2], w[3], n[0], n[1], n[2], c.gap, c.speed})
      csv.write(format(",%.17g", x));
    csv.write(format(",%d,%.17g\n", int(c.degenerate), c.step_limit));
  }
}

void write_step_csv(Output& csv, const onset::StepResult& r) {
  csv.write(std::string(kStepColumns) + "\n");
  csv.write(format("%s,%.17g,", outcome_name(r.outcome), r.step));
  if (const std::optional<onset::Pair>& p = r.limiting)
    csv.write(format("%s,%d,%d,%d,%d,%d,%d", kind_name(p->kind), p->a, p->b, p->vertices[0], p->vertices[1],
                     p->vertices[2], p->vertices[3]));
  else
    csv.write(",,,,,,");
  csv.write(format(",%.17g,%.17g,%.17g\n", r.toi, r.toi_hi, r.rounding));
}

// A point is an edge whose two vertices are the same.
std::string describe_edge(int edge, int v, int w) {
  return v == w ? format("point %d (edge %d)", v, edge) : format("edge %d (vertices %d %d)", edge, v, w);
}

std::string describe(const onset::Pair& pair) {
  const auto& v = pair.vertices;
  if (pair.kind == onset::PairKind::vertex_face)
    return format("vertex %d and face %d (vertices %d %d %d)", pair.a, pair.b, v[1], v[2], v[3]);
  if (pair.kind == onset::PairKind::vertex_edge)
    return format("vertex %d and ", pair.a) + describe_edge(pair.b, v[1], v[2]);
  if (pair.kind == onset::PairKind::vertex_plane) return format("vertex %d and plane %d", pair.a, pair.b);
  return describe_edge(pair.a, v[0], v[1]) + " and " + describe_edge(pair.b, v[2], v[3]);
}

std::string describe(const onset::PairCounts& c) {
  std::string text = format("%lld vertex-face, %lld edge-edge", static_cast<long long>(c.vertex_face),
                            static_cast<long long>(c.edge_edge));
  if (c.vertex_edge > 0) text = format("%lld vertex-edge", static_cast<long long>(c.vertex_edge));
  if (c.vertex_plane > 0) text += format(", %lld vertex-plane", static_cast<long long>(c.vertex_plane));
  return text;
}

// Where the call ended before all pairs were looked at, any of them may touch at any time.
static std::string describe_touch(const onset::StepResult& r) {
  switch (r.outcome) {
    case onset::Outcome::non_finite:
    case onset::Outcome::out_of_range:
    case onset::Outcome::out_of_time:
    case onset::Outcome::out_of_memory:
    case onset::Outcome::out_of_checks:
    case onset::Outcome::cancelled:
      return "touches     not known\n";
    default:
      return std::isfinite(r.toi) ? format("touches     t = %.17g, on the exact motion\n", r.toi)
                                  : "touches     never\n";
  }
}

std::string describe_step(const onset::StepResult& r) {
  std::string text = format("outcome     %s\nstep        %.17g\nlimited by  %s\n", outcome_name(r.outcome),
                            r.step, r.limiting ? describe(*r.limiting).c_str() : "none");
  if (r.vertex >= 0) text += format("vertex      %d\n", r.vertex);
  text += describe_touch(r);
  return text + format("rounding    %.3g, what storing the end of the step may change\n", r.rounding);
}

std::string describe_sizes(std::ptrdiff_t vertices, std::ptrdiff_t edges, std::ptrdiff_t faces) {
  return format("mesh        %td vertices, %td edges, %td faces\n", vertices, edges, faces);
}

std::string describe_sizes(const onset::Mesh& mesh) {
  const std::ptrdiff_t points = mesh.num_points();
  std::string text = describe_sizes(mesh.num_vertices(), mesh.num_edges() - points, mesh.num_faces());
  if (points > 0)
    text.insert(text.size() - 1, format(", %td points (edges of length 0 behind all others)", points));
  return text;
}

std::string describe_active_set(const onset::ActiveSet& set) {
  std::string text = format("outcome     %s\ncontacts    %s\n", outcome_name(set.outcome),
                            describe(set.stats.contacts).c_str());
  if (set.vertex >= 0) text += format("vertex      %d\n", set.vertex);
  if (const onset::Contact* first = set.earliest())
    text += format("earliest    t = %.17g, %s\n", first->toi, describe(*first).c_str());
  return text + describe_stats(set.stats);
}

std::string describe_stats(const onset::Stats& s) {
  return format("candidates  %s\ntolerance   %.3g\nseconds     %.3g (broad %.3g, narrow %.3g)\n",
                describe(s.candidates).c_str(), s.tolerance, s.seconds_total, s.seconds_broad,
                s.seconds_narrow);
}

}  // namespace app
