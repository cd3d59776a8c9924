// Members of the library's plain structs as read-only attributes of the same name.
#pragma once

// In a chain of nb::class_<Type>: .ONSET_FIELD(Type, member)
#define ONSET_FIELD(Type, member) \
  def_ro(#member, &onset::Type::member, ::onset_python::doc(#Type "." #member))
// The same of a list, as an array of numpy without a copy.
#define ONSET_ARRAY(Type, member)                                                               \
  def_prop_ro(                                                                                  \
      #member,                                                                                  \
      [](nanobind::handle self) {                                                               \
        return ::onset_python::array_of(nanobind::cast<const onset::Type&>(self).member, self); \
      },                                                                                        \
      nanobind::sig("def " #member "(self) -> numpy.typing.NDArray"),                           \
      ::onset_python::doc(#Type "." #member))
// The same of a list of pairs, as a structured array.
#define ONSET_RECORDS(Type, member)                                                               \
  def_prop_ro(                                                                                    \
      #member,                                                                                    \
      [](nanobind::handle self) {                                                                 \
        return ::onset_python::records_of(nanobind::cast<const onset::Type&>(self).member, self); \
      },                                                                                          \
      nanobind::sig("def " #member "(self) -> numpy.typing.NDArray"),                             \
      ::onset_python::doc(#Type "." #member))
