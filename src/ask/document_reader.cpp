#include "ask/document_reader.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "files/field.hpp"

namespace poise {
namespace {

/// A key that is given twice means different things to different readers.
void refuse_twins(const Document& document, const Value& value) {
  if (const auto* parts = std::get_if<List>(&value.data))
    for (const Value& part : *parts) refuse_twins(document, part);
  if (const auto* members = std::get_if<Mapping>(&value.data))
    for (auto member = members->begin(); member != members->end(); ++member) {
      const auto same = [&](const Member& other) { return other.key == member->key; };
      if (std::any_of(members->begin(), member, same))
        document.fail(member->at, "\"" + member->key + "\" is given twice");
      refuse_twins(document, member->value);
    }
}

template <class T>
void read_into(T& value, const Field& field);

/// What a value of a type must be, in words.
template <class T>
std::string expected() {
  if constexpr (std::is_same_v<T, bool>) return "true or false";
  if constexpr (std::is_arithmetic_v<T>) return "a number";
  if constexpr (std::is_enum_v<T> || std::is_same_v<T, std::string>) return "a word";
  return "given";
}

/// 180 degrees are pi exactly.
double radians_of(double degrees) { return degrees / 180 * std::numbers::pi; }

/// Reads the keys of a mapping.
class Reader {
 public:
  explicit Reader(const Field& field, Keys known = {}) : field_(field), known_(std::move(known)) {}

  template <class T>
  void operator()(const char* key, T& value, auto&&... rest) {
    known_.push_back(key);
    read_into(value, field_.get(key, expected<T>()));
    if constexpr (sizeof...(rest) > 0) (*this)(rest...);
  }
  void maybe(const char* key, auto& value, auto&&... rest) {
    known_.push_back(key);
    if (const auto field = field_.find(key)) read_into(value.emplace(), *field);
    if constexpr (sizeof...(rest) > 0) maybe(rest...);
  }
  void degrees(const char* key, double& radians, auto&&... rest) {
    known_.push_back(key);
    radians = radians_of(field_.get(key, "an angle in degrees").finite());
    if constexpr (sizeof...(rest) > 0) degrees(rest...);
  }
  /// Refuses what nobody has asked for: it would stand there as if it had been checked.
  void finish() const { field_.mapping(known_); }

 private:
  const Field& field_;
  Keys known_;
};

/// @param size  of the list, where it is known
std::vector<Field> read_list(const Field& field, std::size_t size) {
  std::vector<Field> parts = field.list();
  if (parts.size() != size)
    field.fail("has " + std::to_string(parts.size()) + " numbers, must have " +
               std::to_string(size));
  return parts;
}

template <class T>
T read_index(const Field& field) {
  const double number = field.finite();
  if (!(number >= 0 && number < 1e9) || number != std::floor(number))
    field.fail("must be a whole number, at least 0");
  return static_cast<T>(number);
}

template <class T>
void read_into(T& value, const Field& field) {
  if constexpr (std::is_same_v<T, bool>) {
    value = field.truth();
  } else if constexpr (std::is_integral_v<T>) {
    value = read_index<T>(field);
  } else if constexpr (std::is_same_v<T, double>) {
    value = field.finite();
  } else if constexpr (std::is_same_v<T, std::string>) {
    value = field.text();
  } else if constexpr (std::is_enum_v<T>) {
    const Words words = words_of(value);
    value =
        static_cast<T>(std::find(words.begin(), words.end(), field.word(words)) - words.begin());
  } else if constexpr (std::is_same_v<T, Interval>) {
    const auto parts = read_list(field, 2);
    value = {radians_of(parts[0].finite()), radians_of(parts[1].finite())};
  } else if constexpr (requires { value.squaredNorm(); }) {
    const auto parts = read_list(field, static_cast<std::size_t>(value.size()));
    for (std::size_t k = 0; k < parts.size(); ++k)
      read_into(value[static_cast<Eigen::Index>(k)], parts[k]);
  } else if constexpr (requires { value.has_value(); }) {
    if (!field.is_null()) read_into(value.emplace(), field);
  } else if constexpr (requires { value.emplace_back(); }) {
    for (const Field& part : field.list()) read_into(value.emplace_back(), part);
  } else {
    Reader reader(field);
    if constexpr (requires { value.fields(reader); })
      value.fields(reader);
    else
      fields(value, reader);
    reader.finish();
  }
}

template <int Dim>
Contact<Dim> read_contact(const Field& field) {
  Contact<Dim> contact;
  Keys keys;
  for_each_contact_field<Dim>([&](const char* name, auto member) {
    keys.push_back(name);
    const Field value = field.get(name, "given");
    const bool is_unlimited = std::string_view(name) == "max_normal" && value.is_null();
    if (!is_unlimited) read_into(contact.*member, value);
  });
  field.mapping(keys);
  return contact;
}

template <int Dim>
Load<Dim> read_load(const Field& field) {
  Load<Dim> load;
  Reader read(field, {"name"});
  if (const auto name = field.find("name")) load.name = name->text();
  for_each_load_field<Dim>([&](const char* name, auto member) { read(name, load.*member); });
  read.finish();
  return load;
}

template <int Dim>
CheckDocument<Dim> read_check(const Field& root) {
  CheckDocument<Dim> check;
  Reader read(root, {"poise_result", "command", "options", "name", "shape", "warnings", "contacts",
                     "loads"});
  root.get("options", "{}").mapping({});
  read("dimension", check.dimension, "safety", check.safety);
  read("force_closure", check.force_closure);
  if constexpr (Dim == 2)
    read("angle_deg", check.angle_deg, "domain", check.domain, "fork_deg", check.fork);
  else
    read("up", check.up, "tilt", check.tilt);
  read.finish();
  for (const Field& field : root.get("loads", "a list of loads").list())
    check.loads.push_back(read_load<Dim>(field));
  for (const Field& field : root.get("contacts", "a list of contacts").list())
    check.contacts.push_back(read_contact<Dim>(field));
  return check;
}

template <class Claims>
Claims read_claims(const Field& root) {
  Claims claims;
  Reader reader(root, {"poise_result", "command"});
  claims.fields(reader);
  reader.finish();
  return claims;
}

CurveDocument read_curve(const Field& root) {
  const auto curve = read_claims<CurveDocument>(root);
  const std::vector<Field> optima = root.get("optima", "a list of holds").list();
  for (std::size_t k = 0; k < optima.size(); ++k)
    if (!curve.optima[k].type) optima[k].get("type", "min or max");
  return curve;
}

}  // namespace

template <int Dim>
AnyDocument<Dim> read_document(const Document& document) {
  refuse_twins(document, document.root);
  const Field root(document);
  const Field version = root.get("poise_result", "1, the version of results");
  if (version.finite() != 1) version.fail("must be 1, the version that this program knows");
  const Field command =
      root.get("command", "check, hold, best, turn, curve, capacity or sturdiest");
  const std::string& name =
      command.word({"check", "hold", "best", "turn", "curve", "capacity", "sturdiest"});
  if (name == "check") return read_check<Dim>(root);
  if (name == "hold") return read_claims<HoldDocument<Dim>>(root);
  if (name == "best") return read_claims<BestDocument<Dim>>(root);
  if (name == "turn") return read_claims<TurnDocument<Dim>>(root);
  if (name == "capacity") return read_claims<CapacityDocument<Dim>>(root);
  if (name == "sturdiest") return read_claims<SturdyDocument<Dim>>(root);
  if (Dim == 3) command.fail("is curve, which is for the plane: the grasp is in space");
  return read_curve(root);
}

template AnyDocument<2> read_document<2>(const Document&);
template AnyDocument<3> read_document<3>(const Document&);

}  // namespace poise
