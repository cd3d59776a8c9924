// A stream for messages that a host may not spoil.
#pragma once

#include <locale>
#include <sstream>

namespace onset {

// A plain stream that runs out of memory keeps silent and leaves a part of the text, and writes numbers as
// the host's locale has them: this one throws std::bad_alloc, and knows no locale.
class TextStream : public std::ostringstream {
 public:
  TextStream() {
    exceptions(std::ios::badbit);
    imbue(std::locale::classic());
  }
};

}  // namespace onset
