#include "onset/trade/front.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

namespace app {
namespace {

std::int64_t wrong(const Answers& a) { return a.false_positives.value_or(a.positives); }
double early(const Answers& a) { return a.early ? a.early->mean() : 0; }

// Beyond a tenth, and beyond a billionth of the step, which no simulator can tell.
bool earlier(double x, double y) { return x > 1.1 * y + 1e-9; }

auto accuracy(const Measured& m) {
  return std::tuple(wrong(m.answers), m.answers.budget, early(m.answers), spread(m.us).median);
}

// The middle half of the measurements: unlike the extremes it does not widen with their number.
struct Middle {
  double low, median, high;
};

Middle middle(std::vector<double> us) {
  std::sort(us.begin(), us.end());
  const std::size_t last = us.size() - 1;
  return {us[last / 4], spread(us).median, us[last - last / 4]};
}

// Whether they did the same, check by check: any difference in time is the machine's.
bool same_work(const Measured& a, const Measured& b) {
  const onset::Options &o = a.setting.options, &p = b.setting.options;
  const Answers &x = a.answers, &y = b.answers;
  return o.threads == p.threads && o.instruction_set == p.instruction_set && o.broad_phase == p.broad_phase &&
         o.narrow_phase == p.narrow_phase && o.exactness == p.exactness && x.checks == y.checks &&
         x.inclusion == y.inclusion && x.positives == y.positives && x.budget == y.budget;
}

// Nothing tells them apart.
bool alike(const Measured& a, const Measured& b) {
  const Answers &x = a.answers, &y = b.answers;
  const Middle s = middle(a.us), t = middle(b.us);
  return wrong(x) == wrong(y) && x.budget == y.budget && !earlier(early(x), early(y)) &&
         !earlier(early(y), early(x)) && (same_work(a, b) || (s.low <= t.high && t.low <= s.high));
}

// Whether it answers what the base is asked, and the whole of it.
bool counts(const Measured& m) { return m.setting.same_question && !m.answers.incomplete; }

}  // namespace

bool dominates(const Measured& b, const Measured& a) {
  const Answers &x = b.answers, &y = a.answers;
  if (wrong(x) > wrong(y) || x.budget > y.budget || earlier(early(x), early(y))) return false;
  if (same_work(a, b)) return false;
  const Middle mine = middle(b.us), theirs = middle(a.us);
  if (mine.high < theirs.low) return true;
  const bool better = wrong(x) < wrong(y) || x.budget < y.budget || earlier(early(y), early(x));
  return better && mine.median <= theirs.low;
}

std::vector<std::size_t> pareto_front(const std::vector<Measured>& all) {
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < all.size(); ++i) {
    // Not one that did the same work only: that was measured several times, and once may be slow.
    const auto beats_it = [&](const Measured& m) {
      return counts(m) && dominates(m, all[i]) && std::all_of(all.begin(), all.end(), [&](const Measured& x) {
               return !counts(x) || !same_work(x, all[i]) || dominates(m, x);
             });
    };
    const auto same = [&](std::size_t j) { return alike(all[j], all[i]); };
    if (counts(all[i]) && std::none_of(all.begin(), all.end(), beats_it) &&
        std::none_of(front.begin(), front.end(), same))
      front.push_back(i);
  }
  std::sort(front.begin(), front.end(), [&](std::size_t i, std::size_t j) {
    return spread(all[i].us).median < spread(all[j].us).median;
  });
  return front;
}

bool Target::met(const Measured& m) const {
  const Answers& a = m.answers;
  return (!time_us || spread(m.us).median <= *time_us) &&
         (!earliness || (a.early && early(a) <= *earliness)) &&
         (!false_positives || (a.false_positives && *a.false_positives <= *false_positives)) &&
         (!positives || a.positives <= *positives) && (!budget || a.budget <= *budget);
}

std::optional<std::size_t> recommended(const std::vector<Measured>& all, const Target& target) {
  std::vector<std::size_t> fit = pareto_front(all);
  fit.erase(std::remove_if(fit.begin(), fit.end(), [&](std::size_t i) { return !target.met(all[i]); }),
            fit.end());
  if (fit.empty()) return std::nullopt;
  const bool only_time =
      target.time_us && !target.earliness && !target.false_positives && !target.positives && !target.budget;
  if (!only_time) return fit.front();
  return *std::min_element(fit.begin(), fit.end(),
                           [&](std::size_t i, std::size_t j) { return accuracy(all[i]) < accuracy(all[j]); });
}

}  // namespace app
