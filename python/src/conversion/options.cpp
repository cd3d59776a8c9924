#include "conversion/options.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <unordered_map>

#include "conversion/arrays.hpp"
#include "conversion/callbacks.hpp"
#include "conversion/docs.hpp"

namespace onset_python {
namespace {

template <class T>
T value_of(const char* name, nb::handle value) {
  T result{};
  if constexpr (std::is_same_v<T, double>) {
    if (const std::optional<double> number = real_number(value)) return *number;
  } else if (nb::try_cast(value, result)) {
    return result;
  } else if constexpr (std::is_same_v<T, bool>) {
    if (const std::optional<bool> flag = numpy_flag(value)) return *flag;
  }
  const std::string text =
      std::string("option ") + name + ": " + nb::repr(value).c_str() + " is of another type";
  throw nb::type_error(text.c_str());
}

// An enumerator, or its name.
template <class E>
E enumerator_of(const char* name, nb::handle value) {
  const nb::handle type = nb::type<E>();
  if (nb::isinstance<nb::str>(value)) {
    const nb::object members = type.attr("__members__");
    if (!nb::cast<bool>(members.attr("__contains__")(value))) {
      const std::string text = std::string(name) + " is " + nb::repr(value).c_str() + "; it must be one of " +
                               nb::cast<std::string>(nb::str(", ").attr("join")(members));
      throw nb::value_error(text.c_str());
    }
    return nb::cast<E>(members[value]);
  }
  if (!nb::isinstance(value, type)) {
    const std::string text =
        std::string("option ") + name + ": " + nb::repr(value).c_str() + " is of another type";
    throw nb::type_error(text.c_str());
  }
  return nb::cast<E>(value);
}

std::optional<double> optional_double(const char* name, nb::handle value) {
  if (value.is_none()) return std::nullopt;
  return value_of<double>(name, value);
}

// Handlers of signals run on the main thread alone, and only where it has the lock.
class Signals {
 public:
  Signals()
      : main_thread_(
            nb::cast<unsigned long>(nb::module_::import_("threading").attr("main_thread")().attr("ident"))) {}
  void look() {
    if (PyThread_get_thread_ident() != main_thread_) return;
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < std::chrono::milliseconds(20)) return;
    last_ = now;
    const nb::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
  }

 private:
  unsigned long main_thread_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

// The callback's reference is given up with the lock, wherever the options end.
std::shared_ptr<nb::object> held(nb::handle callback) {
  return {new nb::object(nb::borrow(callback)), [](nb::object* object) {
            const Callback lock;
            if (lock) delete object;
          }};
}

std::function<bool(double)> progress_of(nb::handle callback) {
  auto signals = std::make_shared<Signals>();
  if (callback.is_none()) return [signals](double) { return signals->look(), true; };
  if (!nb::isinstance<nb::callable>(callback)) throw nb::type_error("option progress: it must be callable");
  return [signals, call = held(callback)](double share) {
    signals->look();
    const Callback callback;
    if (!callback) return false;
    const nb::object answer = (*call)(share);
    if (answer.is_none()) return true;
    const int goes_on = PyObject_IsTrue(answer.ptr());
    if (goes_on < 0) throw nb::python_error();
    return goes_on != 0;
  };
}

using Setter = std::function<void(const char*, onset::Options&, nb::handle)>;

template <class T>
Setter plain(T onset::Options::*member) {
  return [member](const char* name, onset::Options& o, nb::handle v) { o.*member = value_of<T>(name, v); };
}
template <class E>
Setter enumerated(E onset::Options::*member) {
  return
      [member](const char* name, onset::Options& o, nb::handle v) { o.*member = enumerator_of<E>(name, v); };
}

const std::unordered_map<std::string, Setter>& setters() {
  using O = onset::Options;
  static const std::unordered_map<std::string, Setter> all = {
      {"tolerance", [](const char* name, O& o, nb::handle v) { o.tolerance = optional_double(name, v); }},
      {"relative_tolerance", plain(&O::relative_tolerance)},
      {"min_separation", plain(&O::min_separation)},
      {"norm", enumerated(&O::norm)},
      {"max_checks", plain(&O::max_checks)},
      {"window", plain(&O::window)},
      {"check_limit", plain(&O::check_limit)},
      {"memory_limit", plain(&O::memory_limit)},
      {"time_limit", plain(&O::time_limit)},
      {"progress", [](const char*, O& o, nb::handle v) { o.progress = progress_of(v); }},
      {"threads", plain(&O::threads)},
      {"exactness", enumerated(&O::exactness)},
      {"touching_may_pass_through", plain(&O::touching_may_pass_through)},
      {"hold_candidates", plain(&O::hold_candidates)},
      {"broad_phase", enumerated(&O::broad_phase)},
      {"narrow_phase", enumerated(&O::narrow_phase)},
      {"instruction_set", enumerated(&O::instruction_set)},
  };
  return all;
}

template <class O, class Other>
O read(const nb::kwargs& named, Other&& other) {
  O options;
  for (const auto& [key, value] : named) {
    const std::string name = nb::cast<std::string>(key);
    if (other(name, options, value)) continue;
    const auto found = setters().find(name);
    if (found == setters().end()) {
      const std::string text = "there is no option '" + name + "' of this call";
      throw nb::type_error(text.c_str());
    }
    found->second(name.c_str(), options, value);
  }
  return options;
}

template <class O>
O interruptible(O options) {
  if (!options.progress) options.progress = progress_of(nb::none());
  return options;
}

}  // namespace

onset::Options query_options_of(const nb::kwargs& named) {
  return read<onset::Options>(named, [](const std::string&, onset::Options&, nb::handle) { return false; });
}

onset::Options options_of(const nb::kwargs& named) { return interruptible(query_options_of(named)); }

onset::LineSearchOptions line_search_options_of(const nb::kwargs& named) {
  return interruptible(read<onset::LineSearchOptions>(
      named, [](const std::string& name, onset::LineSearchOptions& o, nb::handle value) {
        if (name == "gap_share") return o.gap_share = value_of<double>("gap_share", value), true;
        if (name == "d_hat") return o.d_hat = value_of<double>("d_hat", value), true;
        return false;
      }));
}

onset::TruncateOptions truncate_options_of(const nb::kwargs& named) {
  return interruptible(read<onset::TruncateOptions>(
      named, [](const std::string& name, onset::TruncateOptions& o, nb::handle value) {
        if (name == "gap_share") return o.gap_share = value_of<double>("gap_share", value), true;
        if (name == "d_hat") return o.d_hat = optional_double("d_hat", value), true;
        return false;
      }));
}

nb::dict option_docs() {
  nb::dict docs;
  for (const auto& [name, setter] : setters()) docs[name.c_str()] = doc(("Options." + name).c_str());
  return docs;
}

}  // namespace onset_python
