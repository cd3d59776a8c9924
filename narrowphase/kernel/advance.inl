// Kernel text: directional conservative advancement in double lanes.
//
// From t the pair goes on as far as the best direction there, its linear continuation or the pair's own
// normal can certify. With `apart` the certified excess of the distance over d at t = 0, delta =
// max(min(tolerance, apart/4), 16 E7); certificates demand d + delta/2, and a contact is a witness within d +
// delta. So toi is never late, and a pair that never loses 3/4 of its initial gap is never reported, unless
// 16 E7 is more than a quarter of it (docs/theory.md, T1).

// Looks at time t: finds the best direction and an upper bound of the distance.
template <class V, int K>
inline void closest_direction(const State<V, K>& s, V t, bool maximum_norm, V (&w)[3], V& dist) {
  V c[K][3], e1[3], e2[3], f[3], shortest;
  for (int k = 0; k < K; ++k)
    for (int a = 0; a < 3; ++a) c[k][a] = lerp(s.c[0][k][a], s.c[1][k][a], t);
  spanning_edges(c, e1, e2);
  if (maximum_norm) {
    shortest = closest_direction_in_maximum_norm(c, e1, e2, w);
  } else {
    const Nearest<V> nearest = nearest_on_boundary(c);
    best_direction(c, nearest, e1, e2, w);
    interior_point(c, e1, e2, f);
    shortest = sqrt(min(dot(f, f), nearest.f2));
  }
  // A witness errs by at most 10u rho; 16u covers the square root and sums (docs/theory.md, L16).
  dist = shortest * V::all(1 + 0x1p-50) + V::all(16 * kU) * s.rho;
}

// Certifies with the direction w at t, held fixed; g0 and g1 are its products with the corners.
template <class V, int K>
inline V certify_fixed(const State<V, K>& s, const V (&w)[3], bool maximum_norm, V (&g0)[K], V (&g1)[K]) {
  for (int k = 0; k < K; ++k) g0[k] = dot(w, s.c[0][k]), g1[k] = dot(w, s.c[1][k]);
  const V thr =
      V::all(4.25 * kU) * s.rho + separation_wanted(s) * norm_factor(w, maximum_norm) * V::all(1 + 0x1p-49);
  return fixed_certificate(g0, g1, thr, s.t);
}

// Certifies with a direction that turns on as it did since the last time, from w at t to w_b at tb, whose
// choice bounds |w_b|. The quadratic of the corners' least coefficients is below every w(s).c_k(s)
// (docs/theory.md, L11).
template <class V, int K>
inline V certify_moving(const State<V, K>& s, const V (&w)[3], bool maximum_norm, const V (&g0)[K],
                        const V (&g1)[K]) {
  V turned[3], wb[3];
  for (int a = 0; a < 3; ++a) turned[a] = w[a] - s.w_prev[a];
  const V largest = max(abs(turned[0]), max(abs(turned[1]), abs(turned[2])));
  const V since = s.t - s.t_prev;
  const V ahead = min(since / max(largest, V::all(0x1p-60)), one<V>() - s.t);
  const V tb = min(s.t + ahead, one<V>());
  const V rate = (tb - s.t) / since;
  for (int a = 0; a < 3; ++a) wb[a] = w[a] + rate * turned[a];
  const V up = V::all(1 + 0x1p-48);
  const V size_b = maximum_norm ? norm_factor(wb, true) : sqrt(dot(wb, wb));
  const V size_a = norm_factor(w, maximum_norm);
  const V error = V::all(8.25 * kU) * s.rho * max(max(sqrt(dot(wb, wb)), one<V>()), one<V>()) * up;
  const V tau = separation_wanted(s);
  const V m0 = (error + tau * size_a) * up, m2 = (error + tau * size_b) * up;
  const V m1 = V::all(0.5) * (m0 + m2) * up;
  V b0, b1, b2;
  for (int k = 0; k < K; ++k) {
    const V h0 = dot(wb, s.c[0][k]), h1 = dot(wb, s.c[1][k]);
    const V here[3] = {lerp(g0[k], g1[k], s.t), V::all(0.5) * (lerp(g0[k], g1[k], tb) + lerp(h0, h1, s.t)),
                       lerp(h0, h1, tb)};
    b0 = k == 0 ? here[0] : min(here[0], b0);
    b1 = k == 0 ? here[1] : min(here[1], b1);
    b2 = k == 0 ? here[2] : min(here[2], b2);
  }
  const V L = first_root(b0 - m0, b1 - m1, b2 - m2);
  const V reached = select(L >= one<V>(), tb, (s.t + L * (tb - s.t)) * V::all(1 - 0x1p-50));
  const auto turning = (s.t_prev >= zero<V>()) & (since > zero<V>()) & (L > zero<V>());
  return certified<V>(turning, select(reached >= one<V>(), V::all(2), reached));
}

// Certifies with the pair's own normal, one cubic for all corners. A hair before its root its coefficients
// are usually positive, which takes a contact to its time in one step (docs/theory.md, L15).
template <class V, int K>
inline V certify_normal(const State<V, K>& s) {
  const V margin = (s.f_error + separation_wanted(s) * s.n_largest) * V::all(1 + 0x1p-48);
  V x[4] = {s.f[0], s.f[1], s.f[2], s.f[3]};
  right_part(x, s.t);
  const auto side = x[0] < zero<V>();
  for (V& xi : x) xi = select(side, zero<V>() - xi, xi) - margin;
  const V chord = chord_step(x);
  const auto progress = chord > zero<V>(), whole = chord >= one<V>();
  V root = root_near(x, chord) * V::all(1 - 0x1p-40);
  root = select(root > zero<V>(), min(root, one<V>()), zero<V>());
  left_part(x, root);
  const auto positive = (x[0] > zero<V>()) & (x[1] > zero<V>()) & (x[2] > zero<V>()) & (x[3] > zero<V>());
  const V step = max(select(positive, root, zero<V>()), chord);
  const V reached = max((s.t + step * (one<V>() - s.t)) * V::all(1 - 0x1p-50), s.t);
  return certified<V>(progress, select(whole, V::all(2), reached));
}

// Makes one check: decides lanes in contact and moves the others on.
template <class V, int K>
struct Check {
  typename V::Mask contact, stuck;
};
template <class V, int K>
inline Check<V, K> advance(State<V, K>& s, const V (&w)[3], V dist, bool maximum_norm, bool first) {
  V g0[K], g1[K];
  const V fixed = certify_fixed(s, w, maximum_norm, g0, g1);
  V next = max(fixed, certify_normal(s));
  if (!first) next = max(certify_moving(s, w, maximum_norm, g0, g1), next);
  Check<V, K> r;
  r.contact = dist - s.d <= s.delta;
  const auto crawls = (dist > V::all(0.7) * s.dist) & (next - s.t < V::all(0.125) * (one<V>() - s.t));
  s.slow = select(crawls, s.slow + one<V>(), select(s.slow > zero<V>(), s.slow - one<V>(), s.slow));
  r.stuck = (next <= s.t) | (s.slow >= V::all(4));
  s.dist = dist;
  s.checks = s.checks + one<V>();
  const auto moves = next > s.t;
  for (int a = 0; a < 3; ++a) s.w_prev[a] = w[a];
  s.t_prev = select(moves, s.t, s.t_prev);
  s.t = select(moves & (dist - s.d > s.delta), next, s.t);
  return r;
}

template <int K>
inline void report(const State<Doubles, K>& s, int lane, Verdict verdict, KernelResult& r) {
  const auto at = [&](const Doubles& v) { return reinterpret_cast<const double*>(&v)[lane]; };
  r.t = at(s.t) < 1 ? at(s.t) : 1;
  r.distance = at(s.dist);
  r.delta = at(s.delta);
  r.separation = at(s.d);
  r.unit = at(s.unit);
  r.checks = static_cast<long long>(at(s.checks));
  r.verdict = verdict;
  r.touched_by = 2;
}

// A verdict of -1 means that the lane goes on.
template <int K>
inline void judge(const State<Doubles, K>& s, const Check<Doubles, K>& check, const KernelPairs& pairs,
                  int (&verdict)[Doubles::lanes]) {
  const int contact = bits(check.contact), stuck = bits(check.stuck);
  const int done = bits(s.t >= Doubles::all(1)), beyond = bits(s.t > Doubles::all(pairs.t_max));
  const int spent = bits(s.checks >= Doubles::all(static_cast<double>(pairs.max_checks)));
  for (int l = 0; l < Doubles::lanes; ++l) {
    const int bit = 1 << l;
    verdict[l] = -1;
    if ((done | beyond) & bit)
      verdict[l] = int(Verdict::free);
    else if (contact & bit)
      verdict[l] = int(Verdict::contact);
    else if (spent & bit)
      verdict[l] = int(Verdict::max_checks);
    else if (stuck & bit)
      verdict[l] = int(Verdict::stalled);
  }
}

// Returns what each lane keeps beyond d of its gap, which is between `apart` and dist - d (paper, section
// 7.2: d = p d_i). Lanes without room for it, or whose bounds differ by more than 2^-10, become `unsure`.
template <int K>
inline Doubles kept_of(const KernelPairs& pairs, const int (&rows)[Doubles::lanes],
                       const State<Doubles, K>& s, Doubles dist, Doubles apart, Doubles::Mask& unsure) {
  using V = Doubles;
  Points<V> p;
  gather(pairs, rows, p);
  V largest = zero<V>();
  for (int end = 0; end < 2; ++end)
    for (int i = 0; i < 4; ++i)
      for (int a = 0; a < 3; ++a) largest = max(abs(p.p[end][i][a]), largest);
  const V gap = dist - s.d;
  const V rounding =
      (V::all(pairs.storing) * largest + V::all(pairs.storing > 0 ? kStoredLeast : 0)) / s.unit;
  const V wanted = V::all(pairs.gap_share) * gap + V::all(kStoredRoundings) * rounding;
  const V most = V::all(0.5 * (1 + pairs.gap_share)) * apart;
  unsure = unsure | (gap - apart > V::all(0x1p-10) * apart) | (most < wanted);
  return select(apart > zero<V>(), min(most, wanted), zero<V>());
}

// Makes the first check, at t = 0: fixes delta and finds the pairs that start within d.
template <int K>
inline void first_check(const KernelPairs& pairs, const int (&rows)[Doubles::lanes], State<Doubles, K>& s,
                        int (&verdict)[Doubles::lanes]) {
  using V = Doubles;
  const bool maximum_norm = pairs.maximum_norm;
  V w[3], dist;
  closest_direction(s, s.t, maximum_norm, w, dist);
  const V e7 = V::all(7.25 * kU) * s.rho;
  // (w.c - error) / |w|*, with the dual norm, is a lower bound of the distance (docs/theory.md, L17).
  V apart = (least(w, s.c[0]) - e7) / norm_factor(w, maximum_norm) * V::all(1 - 0x1p-49) -
            s.d * V::all(1 + 0x1p-50);
  auto unsure = apart <= zero<V>();
  if (pairs.gap_share > 0 || pairs.storing > 0) {
    const V kept = kept_of(pairs, rows, s, dist, apart, unsure);
    s.d = s.d + kept;
    apart = apart - kept;
  }
  s.delta = max(min(s.delta, V::all(0.25) * apart), V::all(16) * e7);
  const Check<V, K> check = advance(s, w, dist, maximum_norm, true);
  // A start that is apart never gets 0: where d + delta/2 certifies nothing, d alone does (docs/theory.md,
  // T2).
  const auto held = check.contact | check.stuck;
  if (bits(held) != 0) {
    V g0[K], g1[K];
    for (int k = 0; k < K; ++k) g0[k] = dot(w, s.c[0][k]), g1[k] = dot(w, s.c[1][k]);
    const V thr = V::all(4.25 * kU) * s.rho + s.d * norm_factor(w, maximum_norm) * V::all(1 + 0x1p-49);
    s.t = select(held, max(fixed_certificate(g0, g1, thr, zero<V>()), s.t), s.t);
  }
  judge(s, check, pairs, verdict);
  const int initial = bits(unsure) | ~bits(apart > zero<V>());
  const int moved = bits(s.t > zero<V>());
  for (int l = 0; l < Doubles::lanes; ++l) {
    // A pair near contact at 0 that is certified until later is looked at there, if a check is left.
    if (verdict[l] == int(Verdict::contact) && (moved >> l & 1))
      verdict[l] = pairs.max_checks > 1 ? -1 : int(Verdict::max_checks);
    if (initial >> l & 1) verdict[l] = int(Verdict::initial);
  }
}

template <int K>
inline void restore(const KernelResume* resume, const int (&positions)[Doubles::lanes],
                    State<Doubles, K>& s) {
  double t[Doubles::lanes], separation[Doubles::lanes], delta[Doubles::lanes], slow[Doubles::lanes],
      checks[Doubles::lanes];
  for (int l = 0; l < Doubles::lanes; ++l) {
    const KernelResume& r = resume[positions[l]];
    t[l] = r.t, separation[l] = r.separation, delta[l] = r.delta, slow[l] = -r.patience,
    checks[l] = static_cast<double>(r.checks);
  }
  s.t = Doubles::load(t);
  s.d = Doubles::load(separation);
  s.delta = Doubles::load(delta);
  s.slow = Doubles::load(slow);
  s.checks = Doubles::load(checks);
}

template <int K>
inline void check(const KernelPairs& pairs, State<Doubles, K>& s, int (&verdict)[Doubles::lanes]) {
  Doubles w[3], dist;
  closest_direction(s, s.t, pairs.maximum_norm, w, dist);
  judge(s, advance(s, w, dist, pairs.maximum_norm, false), pairs, verdict);
}

// Pairs that were set up and checked twice, which decides most; `waiting` marks those that go on.
template <int K>
struct Pending {
  State<Doubles, K> state;
  int owner[Doubles::lanes];
  int waiting = 0;

  void finish(const int (&verdict)[Doubles::lanes], KernelResult* results) {
    for (int l = 0; l < Doubles::lanes; ++l) {
      if (!(waiting >> l & 1) || verdict[l] < 0) continue;
      report(state, l, Verdict(verdict[l]), results[owner[l]]);
      waiting &= ~(1 << l);
    }
  }
};
template <int K>
inline void refill(const KernelPairs& pairs, const int* subset, int first, int count,
                   const KernelResume* resume, Pending<K>& pending, KernelResult* results) {
  int rows[Doubles::lanes], verdict[Doubles::lanes];
  for (int l = 0; l < Doubles::lanes; ++l) {
    pending.owner[l] = first + l < count ? first + l : count - 1;
    rows[l] = subset[pending.owner[l]];
    pending.waiting |= int(first + l < count) << l;
  }
  set_up(pairs, rows, pending.state);
  if (resume != nullptr) return restore(resume, pending.owner, pending.state);
  first_check(pairs, rows, pending.state, verdict);
  pending.finish(verdict, results);
  if (pending.waiting == 0) return;
  check(pairs, pending.state, verdict);
  pending.finish(verdict, results);
}

template <int K>
inline void move_lane(const State<Doubles, K>& from, int from_lane, State<Doubles, K>& to, int to_lane) {
  const double* source = reinterpret_cast<const double*>(&from) + from_lane;
  double* target = reinterpret_cast<double*>(&to) + to_lane;
  for (int i = 0; i < kFields<K>; ++i) target[Doubles::lanes * i] = source[Doubles::lanes * i];
}

// Lanes are independent: a result does not depend on which pairs share the registers.
template <int K>
inline void advance_all(const KernelPairs& pairs, const int* subset, int count, const KernelResume* resume,
                        KernelResult* results) {
  State<Doubles, K> lanes = {};
  Pending<K> pending;
  int owner[Doubles::lanes], active = 0, next = 0;
  for (int& o : owner) o = -1;
  while (true) {
    for (int l = 0; l < Doubles::lanes; ++l) {
      if (owner[l] >= 0) continue;
      for (; pending.waiting == 0 && next < count; next += Doubles::lanes)
        refill(pairs, subset, next, count, resume, pending, results);
      if (pending.waiting == 0) break;
      const int from = __builtin_ctz(static_cast<unsigned>(pending.waiting));
      pending.waiting &= pending.waiting - 1;
      move_lane(pending.state, from, lanes, l);
      owner[l] = pending.owner[from];
      ++active;
    }
    if (active == 0) return;
    int verdict[Doubles::lanes];
    check(pairs, lanes, verdict);
    for (int l = 0; l < Doubles::lanes; ++l)
      if (owner[l] >= 0 && verdict[l] >= 0) {
        report(lanes, l, Verdict(verdict[l]), results[owner[l]]);
        owner[l] = -1;
        --active;
      }
  }
}

template <int K>
inline double closest_direction_of(const KernelPairs& pairs, int row, double t, double (&w)[3]) {
  int rows[Doubles::lanes];
  for (int& r : rows) r = row;
  State<Doubles, K> s;
  set_up(pairs, rows, s);
  Doubles direction[3], dist;
  closest_direction(s, Doubles::all(t), pairs.maximum_norm, direction, dist);
  double lanes[Doubles::lanes];
  for (int a = 0; a < 3; ++a) {
    direction[a].store(lanes);
    w[a] = lanes[0];
  }
  dist.store(lanes);
  return lanes[0];
}
