// The system gives the process no thread, and later it does.
#include <dlfcn.h>
#include <pthread.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <onset/onset.hpp>
#include <thread>

#include "tests/catch.hpp"
#include "tests/scenes/meshes.hpp"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define ONSET_TEST_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define ONSET_TEST_SANITIZED
#endif
#endif

using namespace onset;

namespace {

[[maybe_unused]] bool none_left = false;
[[maybe_unused]] int refused = 0;

}  // namespace

#ifndef ONSET_TEST_SANITIZED  // they have a pthread_create of their own
// Stands before the system's for every library of the process.
extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*),
                              void* argument) {
  if (none_left) return ++refused, EAGAIN;
  static const auto real = reinterpret_cast<decltype(&pthread_create)>(dlsym(RTLD_NEXT, "pthread_create"));
  return real(thread, attributes, run, argument);
}
#endif

namespace {

enum class Said { answer, no_thread, another };

template <class F>
Said without_threads(const F& call) {
  none_left = true;
  Said said = Said::answer;
  try {
    call();
  } catch (const std::runtime_error& error) {
    said = std::strstr(error.what(), "pthread_create") != nullptr ? Said::no_thread : Said::another;
  } catch (...) {
    said = Said::another;
  }
  none_left = false;
  return said;
}

// Of a process that never had a thread. An exit status says whether f() is true there.
template <class F>
bool in_new_process(const F& f) {
  const pid_t child = fork();
  if (child == 0) {
    alarm(60);
    bool holds = false;
    try {
      holds = f();
    } catch (...) {
    }
    _exit(holds ? 0 : 1);
  }
  int status = -1;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

#ifdef ONSET_TEST_ONETBB
[[maybe_unused]] constexpr Said kExpected = Said::no_thread;
#else
[[maybe_unused]] constexpr Said kExpected = Said::answer;  // on fewer threads
#endif

}  // namespace

TEST_CASE("where no thread is to be had a call says so, and may be made again", "[faults]") {
#ifdef ONSET_TEST_SANITIZED
  WARN("skipped: sanitizers make threads themselves");
#else
  if (std::thread::hardware_concurrency() < 2) {
    WARN("skipped: on one core nobody wants another thread");
    return;
  }
  constexpr int kSide = 12;  // so few edges are sorted by one thread
  scenes::Scene cloth = scenes::joined(scenes::translated(scenes::cloth(kSide, kSide), {0, 0, 0.1}),
                                       scenes::cloth(kSide, kSide));
  cloth.x_t1.topRows(kSide * kSide).col(2).array() -= 0.2;
  const Eigen::MatrixXi spheres = scenes::sphere_onto_sphere(24, 36, 0.01, 0.2).faces;
  const Mesh mesh(cloth.x_t0, cloth.faces);
  Options one, two;
  one.threads = 1, two.threads = 2;
  const auto step = [&](const Options& o) {
    return compute_collision_free_stepsize(mesh, cloth.x_t0, cloth.x_t1, o).step;
  };
  CHECK(in_new_process([&] {
    double expected = -1, answer = -1;
    const Said alone = without_threads([&] { expected = step(one); });
    if (alone != Said::answer || refused > 0) return false;
    const Said said = without_threads([&] { answer = step(two); });
    if (said != kExpected || refused == 0) return false;
    if (said == Said::answer && answer != expected) return false;
    if (without_threads([&] { answer = step(two); }) != Said::answer || answer != expected) return false;
    return step(two) == expected;
  }));
  CHECK(in_new_process([&] {
    std::ptrdiff_t made = -1;
    const Said said = without_threads([&] { made = edges(spheres).rows(); });
    if (said != kExpected || refused == 0) return false;
    const std::ptrdiff_t expected = spheres.rows() * 3 / 2;  // each is of two faces
    return (said != Said::answer || made == expected) && edges(spheres).rows() == expected;
  }));
#endif
}
