// Which pairs of blocks of two sides of the hash may meet.
#pragma once

#include "broadphase/hash/hash_side.hpp"

namespace onset {

// Some blocks of one side, which ask for those of another, or their own, that may meet them: on their own
// level, where the query asks or both are one side, and on the levels above.
struct BlockPairs {
  const HashSide &asking, &asked;
  // Whether those that ask are the query; else they are the other tree.
  bool query_asks;
  bool self;
  // Whether they are motion boxes.
  bool motion;
  std::size_t first, last;  // units of eight blocks of `asking`

  // As TraverseArguments::list; `context` is such a one.
  static void list(const void* context, const BlockRunSink& sink);
};

}  // namespace onset
