// What C++ and Python hand each other as plain values: the types of poise/_types.py.
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <variant>

#include "poise/best_posture.hpp"
#include "poise/best_spatial_posture.hpp"
#include "shape/shape.hpp"

namespace poise::python {

namespace py = pybind11;

/// A class of poise/_types.py.
inline py::object type(const char* name) { return py::module_::import("poise._types").attr(name); }

/// The words of an enumeration, in the order of its values.
template <class E>
struct Words;
template <>
struct Words<ContactState> {
  static constexpr auto name = py::detail::const_name("ContactState");
  static constexpr std::array list{"unloaded", "sticking", "slipping"};
};
template <>
struct Words<ForceLimit> {
  static constexpr auto name = py::detail::const_name("ForceLimit");
  static constexpr std::array list{"none", "min", "max"};
};
template <>
struct Words<Manner> {
  static constexpr auto name = py::detail::const_name("Manner");
  static constexpr std::array list{"resting", "cradled", "pinched"};
};
template <>
struct Words<Kind> {
  static constexpr auto name = py::detail::const_name("Kind");
  static constexpr std::array list{"boundary", "kink", "smooth"};
};
template <>
struct Words<Status> {
  static constexpr auto name = py::detail::const_name("Status");
  static constexpr std::array list{"optimal", "gap", "unholdable"};
};
template <>
struct Words<Domain> {
  static constexpr auto name = py::detail::const_name("Domain");
  static constexpr std::array list{"all", "pinched"};
};

/// An enumeration of C++ as one of Python.
template <class E>
struct EnumCaster {
  PYBIND11_TYPE_CASTER(E, Words<E>::name);

  bool load(py::handle source, bool) {
    const py::object python = type(Words<E>::name.text);
    if (!py::isinstance(source, python)) return false;
    const auto word = source.attr("name").cast<std::string>();
    for (std::size_t k = 0; k < Words<E>::list.size(); ++k)
      if (word == Words<E>::list[k]) value = static_cast<E>(k);
    return true;
  }
  static py::handle cast(E source, py::return_value_policy, py::handle) {
    const auto* const word = Words<E>::list[static_cast<std::size_t>(source)];
    return py::object(type(Words<E>::name.text).attr(word)).release();
  }
};

/// What the plane and space have under one name in Python.
template <template <int> class T>
struct Either {
  std::variant<T<2>, T<3>> of;
};
using AnyGrasp = Either<Grasp>;
using AnyHold = Either<Hold>;

/// What `f` makes of either of them.
template <class E, class F>
auto each(F f) {
  return [f](const E& either) { return std::visit(f, either.of); };
}

/// What `f` makes of a grasp and a hold of it.
/// @throws InvalidGrasp for a hold of another grasp, whose forces make no sense
template <class F>
auto each(const AnyGrasp& any, const AnyHold& hold, F f) {
  return std::visit(
      [&]<int Dim>(const Grasp<Dim>& grasp) {
        const auto* const own = std::get_if<Hold<Dim>>(&hold.of);
        if (!own || (own->holdable && own->forces.size() != grasp.contacts().size()))
          throw InvalidGrasp("hold", "is of another grasp");
        return f(grasp, *own);
      },
      any.of);
}

/// The grasp, of that dimension alone.
template <int Dim>
const Grasp<Dim>& only(const AnyGrasp& grasp) {
  if (const auto* const own = std::get_if<Grasp<Dim>>(&grasp.of)) return *own;
  throw InvalidGrasp("grasp", Dim == 2 ? "is in space, must be in the plane"
                                       : "is in the plane, must be in space");
}

/// Numbers as many as needed; `path` is their name in messages.
template <int Size>
Eigen::Matrix<double, Size, 1> sized(const Eigen::VectorXd& numbers, const std::string& path) {
  if (numbers.size() != Size)
    throw InvalidGrasp(path, "has " + std::to_string(numbers.size()) + " numbers, must have " +
                                 std::to_string(Size));
  return numbers;
}

/// A vector from Python's attribute of that name; `path` is its name in messages.
template <int Dim>
Vector<Dim> read_vector(py::handle source, const char* name, const std::string& path) {
  return sized<Dim>(source.attr(name).cast<Eigen::VectorXd>(), path + name);
}

/// A direction of any length, made a unit vector.
template <int Dim>
Vector<Dim> unit(const Eigen::VectorXd& up, const std::string& path = "up") {
  const Vector<Dim> given = sized<Dim>(up, path);
  if (!given.allFinite() || given.isZero(0)) throw InvalidGrasp(path, "must be a direction");
  return given.stableNormalized();
}

/// A force cap [weights], in the range of the program's --force-cap.
inline double checked_cap(double force_cap) {
  if (!(force_cap > 0 && force_cap <= 1e9))
    throw InvalidGrasp("force_cap", "must be above 0 and at most 1e9");
  return force_cap;
}

template <int Dim>
Object<Dim> read_object(py::handle source) {
  return {.weight = source.attr("weight").cast<double>(),
          .com = read_vector<Dim>(source, "com", "object.")};
}

template <int Dim>
std::vector<Contact<Dim>> read_contacts(const py::iterable& source) {
  std::vector<Contact<Dim>> contacts;
  for (const py::handle contact : source) {
    const std::string path = "contacts[" + std::to_string(contacts.size()) + "].";
    contacts.push_back({.position = read_vector<Dim>(contact, "position", path),
                        .normal = read_vector<Dim>(contact, "normal", path),
                        .friction = contact.attr("friction").cast<double>(),
                        .min_normal = contact.attr("min_normal").cast<double>(),
                        .max_normal = contact.attr("max_normal").cast<double>(),
                        .share = contact.attr("share").cast<double>(),
                        .finger = contact.attr("finger").cast<std::string>(),
                        .torsion = contact.attr("torsion").cast<double>()});
  }
  return contacts;
}

/// Numbers as they are shown: "[1, 2.5]".
template <class Numbers>
std::string shown(const Numbers& numbers) {
  py::list list;
  for (const double number : numbers) list.append(py::str("{:.6g}").format(number));
  return "[" + py::str(", ").attr("join")(list).template cast<std::string>() + "]";
}

template <int Dim>
py::object write(const Object<Dim>& object) {
  return type("Object")(object.weight, object.com);
}

template <int Dim>
py::list write(const std::vector<Contact<Dim>>& contacts) {
  const py::object python = type("Contact");
  py::list list;
  for (const Contact<Dim>& contact : contacts)
    list.append(python(contact.position, contact.normal, contact.friction, contact.min_normal,
                       contact.max_normal, contact.share, contact.finger, contact.torsion));
  return list;
}

}  // namespace poise::python

namespace pybind11::detail {
template <>
struct type_caster<poise::ContactState> : poise::python::EnumCaster<poise::ContactState> {};
template <>
struct type_caster<poise::ForceLimit> : poise::python::EnumCaster<poise::ForceLimit> {};
template <>
struct type_caster<poise::Manner> : poise::python::EnumCaster<poise::Manner> {};
template <>
struct type_caster<poise::Kind> : poise::python::EnumCaster<poise::Kind> {};
template <>
struct type_caster<poise::Status> : poise::python::EnumCaster<poise::Status> {};
template <>
struct type_caster<poise::Domain> : poise::python::EnumCaster<poise::Domain> {};
}  // namespace pybind11::detail
