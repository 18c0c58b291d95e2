// What C++ and Python hand each other as plain values: the types of poise/_types.py.
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>
#include <variant>

#include "ask/claims.hpp"
#include "docstrings.hpp"
#include "poise/best_posture.hpp"
#include "shape/shape.hpp"

namespace poise::python {

namespace py = pybind11;

/// A class of poise/_types.py.
inline py::object type(const char* name) { return py::module_::import("poise._types").attr(name); }

/// The name of an enumeration in Python, where its values are the words that documents have.
template <class E>
inline constexpr auto enum_name = nullptr;
template <>
inline constexpr auto enum_name<ContactState> = py::detail::const_name("ContactState");
template <>
inline constexpr auto enum_name<ForceLimit> = py::detail::const_name("ForceLimit");
template <>
inline constexpr auto enum_name<Manner> = py::detail::const_name("Manner");
template <>
inline constexpr auto enum_name<Kind> = py::detail::const_name("Kind");
template <>
inline constexpr auto enum_name<Status> = py::detail::const_name("Status");
template <>
inline constexpr auto enum_name<Objective> = py::detail::const_name("Objective");
template <>
inline constexpr auto enum_name<Domain> = py::detail::const_name("Domain");

}  // namespace poise::python

namespace pybind11::detail {

/// An enumeration of C++ as one of Python.
template <class E>
requires(!std::is_same_v<decltype(poise::python::enum_name<E>),
                         const std::nullptr_t>) struct type_caster<E> {
  PYBIND11_TYPE_CASTER(E, poise::python::enum_name<E>);

  bool load(handle source, bool) {
    const object python = poise::python::type(poise::python::enum_name<E>.text);
    if (!isinstance(source, python)) return false;
    const auto words = poise::words_of(E{});
    const auto word = source.attr("value").cast<std::string>();
    value = static_cast<E>(std::find(words.begin(), words.end(), word) - words.begin());
    return true;
  }
  static handle cast(E source, return_value_policy, handle) {
    const std::string word(poise::words_of(source)[static_cast<std::size_t>(source)]);
    return poise::python::type(poise::python::enum_name<E>.text)(word).release();
  }
};

}  // namespace pybind11::detail

namespace poise::python {

/// What the plane and space have under one name in Python.
template <template <int> class T>
struct Either {
  std::variant<T<2>, T<3>> of;
};
using AnyGrasp = Either<Grasp>;
using AnyHold = Either<Hold>;
using GraspPointer = std::shared_ptr<AnyGrasp>;

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

/// What the headers of the library say of a name, "Hold.effort".
inline const char* comment(std::string name) {
  if (name.ends_with('_')) name.pop_back();
  const auto found = comments_of_headers.find(name);
  return found == comments_of_headers.end() ? "" : found->second.c_str();
}

/// A class of Python. What has no words of its own has those of the header, where the class may
/// have another name.
template <class T, class... Options>
class Class : public py::class_<T, Options...> {
 public:
  Class(py::module_& module, const char* name, const char* words = nullptr,
        const char* name_in_header = nullptr)
      : py::class_<T, Options...>(module, name, words ? words : comment(name)),
        name_(name_in_header ? name_in_header : name) {}

  /// An attribute: a member, or what `get` makes of the object.
  template <class Get>
  Class& attribute(const char* name, Get get, const char* words = nullptr) {
    if (!words) words = comment(name_ + "." + name);
    if constexpr (std::is_member_object_pointer_v<Get>)
      this->def_readonly(name, get, words);
    else
      this->def_property_readonly(name, get, words);
    return *this;
  }
  /// What `get` makes of what it has in either dimension.
  template <class Get>
  Class& either(const char* name, Get get, const char* words = nullptr) {
    return attribute(name, each<T>(get), words);
  }

 private:
  std::string name_;
};

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

/// The load at an index, which may be left out where there is one.
/// @throws InvalidGrasp where there are several and no index
template <int Dim>
const Load<Dim>& load_of(const Grasp<Dim>& grasp, std::optional<std::size_t> index) {
  const std::size_t count = grasp.loads().size();
  if (!index && count > 1)
    throw InvalidGrasp(
        "load", "is missing, must be an index: the grasp has " + std::to_string(count) + " loads");
  if (index.value_or(0) >= count) throw py::index_error("no such load");
  return grasp.loads()[index.value_or(0)];
}

/// A direction of any length, made a unit vector.
template <int Dim>
Vector<Dim> unit(const Eigen::VectorXd& up, const std::string& path = "up") {
  const Vector<Dim> given = sized<Dim>(up, path);
  if (!given.allFinite() || given.isZero(0)) throw InvalidGrasp(path, "must be a direction");
  return given.stableNormalized();
}

/// A Tilt, or None.
inline std::optional<Tilt> read_tilt(const py::object& tilt) {
  if (tilt.is_none()) return {};
  return Tilt{unit<3>(tilt.attr("from_").cast<Eigen::VectorXd>(), "tilt.from_"),
              tilt.attr("most").cast<double>()};
}

/// A force cap [weights], in the range of the program's --force-cap.
inline double checked_cap(double force_cap) {
  if (!(force_cap > 0 && force_cap <= 1e9))
    throw InvalidGrasp("force_cap", "must be above 0 and at most 1e9");
  return force_cap;
}

/// A Load, or several.
template <int Dim>
std::vector<Load<Dim>> read_loads(const py::object& source) {
  std::vector<Load<Dim>> loads;
  const auto add = [&](const py::handle load) {
    const std::string path = "loads[" + std::to_string(loads.size()) + "].";
    loads.push_back({.weight = load.attr("weight").cast<double>(),
                     .com = read_vector<Dim>(load, "com", path),
                     .fixed = sized<wrench_size<Dim>>(load.attr("fixed").cast<Eigen::VectorXd>(),
                                                      path + "fixed"),
                     .lift = load.attr("lift").cast<double>(),
                     .acceleration = read_vector<Dim>(load, "acceleration", path),
                     .name = load.attr("name").cast<std::string>()});
  };
  if (py::isinstance(source, type("Load")))
    add(source);
  else
    for (const py::handle load : source) add(load);
  return loads;
}

/// A Pad, or None.
inline std::optional<Pad> read_pad(py::handle source, const std::string& path) {
  if (source.is_none()) return {};
  Pad pad{.axis = read_vector<3>(source, "axis", path + "."),
          .reach = read_vector<2>(source, "reach", path + ".")};
  for (const py::handle point : source.attr("points"))
    pad.points.push_back(sized<3>(point.cast<Eigen::VectorXd>(), path + ".points"));
  pad.shares = source.attr("shares").cast<std::vector<double>>();
  return pad;
}
inline py::object write(const std::optional<Pad>& pad) {
  if (!pad) return py::none();
  return type("Pad")(pad->points, pad->shares, pad->axis, pad->reach);
}

template <int Dim>
std::vector<Contact<Dim>> read_contacts(const py::iterable& source) {
  std::vector<Contact<Dim>> contacts;
  for (const py::handle python : source) {
    const std::string path = "contacts[" + std::to_string(contacts.size()) + "].";
    Contact<Dim>& contact = contacts.emplace_back();
    contact.torsion = python.attr("torsion").cast<double>();  // in the plane, too: to be refused
    for_each_contact_field<Dim>([&]<class T>(const char* name, T Contact<Dim>::*field) {
      if constexpr (std::is_same_v<T, Vector<Dim>>)
        contact.*field = read_vector<Dim>(python, name, path);
      else if constexpr (std::is_same_v<T, std::optional<Pad>>)
        contact.*field = read_pad(python.attr(name), path + name);
      else
        contact.*field = python.attr(name).cast<T>();
    });
  }
  return contacts;
}

/// Contacts that make the same grasp again, when their friction is not divided any more.
template <int Dim>
std::vector<Contact<Dim>> given_contacts(const Grasp<Dim>& grasp) {
  std::vector<Contact<Dim>> contacts = grasp.contacts();
  std::vector<int> contacts_of(grasp.fingers().size());
  for (std::size_t i = 0; i < contacts.size(); ++i) ++contacts_of[grasp.finger_of(i)];
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (contacts_of[grasp.finger_of(i)] == 1 && contacts[i].finger == std::to_string(i))
      contacts[i].finger.clear();  // another one may have the same label
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
py::list write(const std::vector<Load<Dim>>& loads) {
  using namespace py::literals;  // NOLINT(google-build-using-namespace): _a
  const py::object python = type("Load");
  py::list list;
  for (const Load<Dim>& load : loads)
    list.append(python(load.weight, load.com, "fixed"_a = load.fixed, "lift"_a = load.lift,
                       "acceleration"_a = load.acceleration, "name"_a = load.name));
  return list;
}

template <int Dim>
py::list write(const std::vector<Contact<Dim>>& contacts) {
  const py::object python = type("Contact");
  py::list list;
  for (const Contact<Dim>& contact : contacts) {
    py::dict fields;
    for_each_contact_field<Dim>([&]<class T>(const char* name, T Contact<Dim>::*field) {
      if constexpr (std::is_same_v<T, std::optional<Pad>>)
        fields[name] = write(contact.*field);
      else
        fields[name] = contact.*field;
    });
    list.append(python(**fields));
  }
  return list;
}

}  // namespace poise::python
