// Ends the program, naming what it was at, where that does not end by itself.
#pragma once

#include <unistd.h>

#include <csignal>
#include <cstring>

namespace onset::tests {

// While one lives: two minutes, thousands of times what a call takes.
class Watchdog {
 public:
  explicit Watchdog(const char* name) {
    current() = name;
    std::signal(SIGALRM, &Watchdog::bark);
    alarm(120);
  }
  ~Watchdog() { alarm(0); }
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

 private:
  static const char*& current() {
    static const char* name = "";
    return name;
  }
  static void bark(int) {
    for (const char* text : {"a call hangs: ", static_cast<const char*>(current()), "\n"})
      if (write(2, text, std::strlen(text)) < 0) break;
    _exit(1);
  }
};

}  // namespace onset::tests
