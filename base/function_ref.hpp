// A callable that somebody else keeps, called through a pointer: what takes one need not be a template.
#pragma once

#include <utility>

namespace onset {

template <class... Arguments>
class FunctionRef {
 public:
  // f must live as long as this is called.
  template <class F>
  explicit FunctionRef(const F& f)
      : context_(&f),
        call_([](const void* context, Arguments... a) { (*static_cast<const F*>(context))(a...); }) {}
  void operator()(Arguments... a) const { call_(context_, a...); }

 private:
  const void* context_;
  void (*call_)(const void*, Arguments...);
};

}  // namespace onset
