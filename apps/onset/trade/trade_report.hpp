// What `onset trade` prints.
#pragma once

#include <optional>
#include <vector>

#include "onset/results/outputs.hpp"
#include "onset/trade/front.hpp"
#include "onset/trade/subject.hpp"

namespace app {

struct TradeReport {
  const Subject& subject;
  const std::vector<Measured>& settings;  // the base first
  std::vector<std::size_t> front;
  Target target;
  std::optional<std::size_t> recommended;

  bool base_on_front() const;
};

extern const char* const kTradeColumns;

Json to_json(const TradeReport& report);
std::string describe(const TradeReport& report);
void write_csv(Output& csv, const TradeReport& report);

}  // namespace app
