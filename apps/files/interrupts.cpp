#include "files/interrupts.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>

namespace app {
namespace {

// Who may touch the list: the code that works on it, or the signal that ends the program. A signal that comes
// while the list is worked on, on whatever thread, waits in `pending`.
enum State { idle, working, ending };
std::atomic<int> state{idle};
std::atomic<int> pending{0};
static_assert(std::atomic<int>::is_always_lock_free, "signal handlers use it");

std::vector<std::string>& unfinished() {
  static auto& paths = *new std::vector<std::string>;  // a signal may come after what is static has gone
  return paths;
}

// Ends the program as if the signal had never been caught.
void end_by(int signal) {
  struct sigaction standard = {};
  standard.sa_handler = SIG_DFL;
  sigaction(signal, &standard, nullptr);
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, signal);
  raise(signal);
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

// Calls nothing but what a signal handler may call.
void end(int signal) {
  const int error = errno;
  pending = signal;
  int expected = idle;
  if (state.compare_exchange_strong(expected, ending)) {
    for (const std::string& path : unfinished()) unlink(path.c_str());
    end_by(signal);
  }
  errno = error;
}

class Work {
 public:
  Work() {
    for (int expected = idle; !state.compare_exchange_weak(expected, working); expected = idle)
      if (expected == ending) pause();  // on another thread, which ends the program
  }
  ~Work() {
    state = idle;
    if (const int signal = pending) end(signal);
  }
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;
};

void forget(const std::string& path) {
  auto& paths = unfinished();
  paths.erase(std::remove(paths.begin(), paths.end(), path), paths.end());
}

// Where an unfinished file goes, and the name that what stands there has meanwhile.
struct Place {
  const std::string &unfinished, &path;
  std::string kept;
  bool is_kept = false;
};

// Gives what stands there another name, or moves it there where it may have no two; nothing may stand there.
bool keep(Place& place) {
  place.is_kept = link(place.path.c_str(), place.kept.c_str()) == 0;
  if (place.is_kept || errno == ENOENT) return true;
  struct stat file;
  if (lstat(place.path.c_str(), &file) != 0) return errno == ENOENT;
  if (S_ISDIR(file.st_mode)) errno = EISDIR;
  place.is_kept = !S_ISDIR(file.st_mode) && std::rename(place.path.c_str(), place.kept.c_str()) == 0;
  return place.is_kept;
}

void give_back(const Place& place) {
  if (!place.is_kept) {
    std::rename(place.path.c_str(), place.unfinished.c_str());
  } else {
    std::rename(place.kept.c_str(), place.path.c_str());
    unlink(place.kept.c_str());  // which is still there where both names were of one file
  }
}

// Returns false, with all as it was and errno set, where it cannot be taken.
bool take(Place& place) {
  if (!keep(place)) return false;
  if (std::rename(place.unfinished.c_str(), place.path.c_str()) == 0) return true;
  const int error = errno;
  if (place.is_kept) give_back(place);
  errno = error;
  return false;
}

void open_standard_files() {
  for (int descriptor = 0; descriptor <= 2; ++descriptor)
    if (fcntl(descriptor, F_GETFD) < 0 && errno == EBADF)  // the lowest free one is what open() takes
      if (open("/dev/null", descriptor == STDOUT_FILENO ? O_RDONLY : O_RDWR) < 0) return;
}

}  // namespace

void prepare_process() {
  open_standard_files();
  unfinished();  // made before a handler can ask for it
  signal(SIGXFSZ, SIG_IGN);
  for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGPIPE, SIGXCPU}) {
    struct sigaction now;
    if (sigaction(signal, nullptr, &now) != 0 || now.sa_handler != SIG_DFL) continue;
    struct sigaction handled = {};
    handled.sa_handler = end;
    handled.sa_flags = SA_RESTART;
    sigaction(signal, &handled, nullptr);
  }
}

int create_unfinished(const std::string& folder, std::string& path) {
  static int made = 0;
  const Work work;
  while (true) {
    path = folder + "/.onset-" + std::to_string(getpid()) + "-" + std::to_string(made++) + ".part";
    unfinished().push_back(path);
    const int descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) return descriptor;
    const int error = errno;
    forget(path);  // another program's, if there is one
    path.clear();
    errno = error;
    if (error != EEXIST) return -1;
  }
}

void discard_unfinished(const std::string& path) {
  const Work work;
  unlink(path.c_str());
  forget(path);
}

std::size_t publish_unfinished(const std::vector<std::pair<std::string, std::string>>& files) {
  std::vector<Place> places;
  for (const auto& [unfinished, path] : files) places.push_back({unfinished, path, unfinished + ".old"});
  const Work work;
  std::size_t taken = 0;
  while (taken < places.size() && take(places[taken])) ++taken;
  const int error = errno;
  if (taken < places.size()) {
    for (std::size_t i = taken; i-- > 0;) give_back(places[i]);
  } else {
    for (const Place& place : places) {
      if (place.is_kept) unlink(place.kept.c_str());
      forget(place.unfinished);
    }
  }
  errno = error;
  return taken;
}

}  // namespace app
