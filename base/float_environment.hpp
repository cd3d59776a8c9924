// The floating-point environment that every promise is made in, whatever the host has set.
#pragma once

#include <utility>

#if !defined(__SSE2__) && !defined(__aarch64__)
#include <cfenv>
#endif

namespace onset {

// While one lives, this thread rounds to nearest, keeps subnormal numbers and traps nothing; then it has the
// host's environment and flags again. A few cycles.
class FloatEnvironment {
 public:
  FloatEnvironment(const FloatEnvironment&) = delete;
  FloatEnvironment& operator=(const FloatEnvironment&) = delete;

#if defined(__SSE2__)
  FloatEnvironment() : host_(__builtin_ia32_stmxcsr()) {
    __builtin_ia32_ldmxcsr(0x1f80);
    asm volatile("" ::: "memory");  // what is read afterwards is not computed with before
  }
  ~FloatEnvironment() {
    asm volatile("" ::: "memory");
    __builtin_ia32_ldmxcsr(host_);
  }

 private:
  unsigned host_;
#elif defined(__aarch64__)
  FloatEnvironment() {
    asm volatile("mrs %0, fpcr" : "=r"(host_));
    asm volatile("mrs %0, fpsr" : "=r"(flags_));
    asm volatile("msr fpcr, %0" ::"r"(0ul) : "memory");
  }
  ~FloatEnvironment() {
    asm volatile("msr fpcr, %0" ::"r"(host_) : "memory");
    asm volatile("msr fpsr, %0" ::"r"(flags_));
  }

 private:
  unsigned long host_, flags_;
#else
  FloatEnvironment() {
    std::fegetenv(&host_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~FloatEnvironment() { std::fesetenv(&host_); }

 private:
  std::fenv_t host_;
#endif
};

// f(arguments...) in that environment. Not inlined: no arithmetic of it may move out.
template <class F, class... Arguments>
#if defined(__GNUC__)
__attribute__((noinline))
#endif
decltype(auto)
in_float_environment(F&& f, Arguments&&... arguments) {
  const FloatEnvironment environment;
  return std::forward<F>(f)(std::forward<Arguments>(arguments)...);
}

}  // namespace onset
