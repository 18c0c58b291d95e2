#include "flags.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>

#include "files/text.hpp"

namespace poise {
namespace {

/// Numbers between commas; empty if they are none.
std::vector<double> parsed_list(std::string_view text) {
  std::vector<double> numbers;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const auto number = parsed_number(text.substr(at, comma - at));
    if (!number) return {};
    numbers.push_back(*number);
    at = comma + 1;
  }
  return numbers;
}

Domain read_domain(const std::string& text) {
  if (text == "all") return Domain::all;
  if (text == "pinching-up") return Domain::pinching_up;
  throw UsageError("--domain: " + in_quotes(text) + " must be all or pinching-up");
}

}  // namespace

std::optional<double> parsed_number(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end || !std::isfinite(value)) return {};
  return value;
}

double read_number(const std::string& flag, const std::string& text, const std::string& must_be,
                   bool (*in_range)(double)) {
  const auto value = parsed_number(text);
  if (value && (!in_range || in_range(*value))) return *value;
  throw UsageError(flag + ": " + in_quotes(text) + " is not " + must_be);
}

std::vector<double> read_direction(const std::string& flag, const std::string& text,
                                   std::size_t least, std::size_t most,
                                   const std::string& examples) {
  std::vector<double> numbers = parsed_list(text);
  if (numbers.size() < least || numbers.size() > most)
    throw UsageError(flag + ": " + in_quotes(text) + " is not a direction, must be like " +
                     examples);
  if (std::all_of(numbers.begin(), numbers.end(), [](double number) { return number == 0; }))
    throw UsageError(flag + ": " + text + " has no direction");
  return numbers;
}

Eigen::Quaterniond read_quaternion(const std::string& flag, const std::string& text) {
  const std::vector<double> v = parsed_list(text);
  if (v.size() != 4)
    throw UsageError(flag + ": " + in_quotes(text) +
                     " is not a quaternion, must be like 1,0,0,0 (w first)");
  const Eigen::Vector4d wxyz = Eigen::Vector4d(v[0], v[1], v[2], v[3]).stableNormalized();
  if (!(wxyz.norm() > 0.5)) throw UsageError(flag + ": " + text + " has no length");
  return {wxyz[0], wxyz[1], wxyz[2], wxyz[3]};
}

std::string in_quotes(const std::string& text) { return "'" + shown(text) + "'"; }

void Flags::argument(const std::string& name, const std::string& help, std::string& value,
                     const std::string& takes) {
  app_.add_option(name, value, help)->type_name("")->required();
  takes_.push_back(takes);
}

void Flags::arguments(const std::string& name, const std::string& help,
                      std::vector<std::string>& values, const std::string& takes) {
  app_.add_option(name, values, help)->type_name("")->required();
  takes_.push_back(takes);
}

Flags& Flags::value(const std::string& names, const std::string& type, const std::string& help,
                    std::function<void(const std::string&)> read) {
  last_ = app_.add_option(names, help)->type_name(type);
  readers_.emplace_back([option = last_, read = std::move(read)] {
    if (option->count() > 0) read(option->as<std::string>());
  });
  return *this;
}

Flags& Flags::file(const std::string& names, const std::string& type, const std::string& help,
                   std::string& value) {
  return this->value(names, type, help,
                     [flag = names.substr(names.find("--")), &value](const auto& text) {
                       if (text.empty()) throw UsageError(flag + ": '' is not a file");
                       value = text;
                     });
}

Flags& Flags::folder(const std::string& name, const std::string& help, std::string& value) {
  return this->value(name, "DIR", help, [&value](const auto& text) { value = text; });
}

void Flags::required() { last_->required(); }

void Flags::flag(const std::string& name, const std::string& help, bool& value) {
  app_.add_flag(name, value, help)->disable_flag_override();
}

void Flags::posture(Question& question, const std::string& posture) {
  value("--angle", "DEG", posture + ": the object turned counter-clockwise", [&](const auto& text) {
    question.angle_deg = read_number("--angle", text, "a number of degrees");
  });
  CLI::Option* const angle = last_;
  value("--up", "X,Y[,Z]", posture + ": the direction against gravity", [&](const auto& text) {
    question.up = read_direction("--up", text, 2, 3, "0.5,0.8 (in space 0.5,0,0.8)");
  });
  last_->excludes(angle);
}

void Flags::domain(Question& question) {
  value("--domain", "all|pinching-up",
        "Postures to choose from: all, or those outside the fork of the fingers",
        [&](const auto& text) { question.domain = read_domain(text); });
}

void Flags::objective(Question& question, bool sturdy) {
  value("--objective", sturdy ? "grip|effort|sturdy" : "grip|effort",
        "What is to be least: the grip, or the sum of squares of the forces" +
            std::string(sturdy ? "; sturdy: the posture that withstands most" : ""),
        [&question, sturdy](const auto& text) {
          if (sturdy && text == "sturdy") {
            question.command = Command::sturdiest;
            return;
          }
          if (text != "grip" && text != "effort")
            throw UsageError(
                "--objective: " + in_quotes(text) +
                (sturdy ? " must be grip, effort or sturdy" : " must be grip or effort"));
          question.objective = text == "grip" ? Objective::grip : Objective::effort;
        });
}

void Flags::force_cap(Question& question) {
  value(
      "--force-cap", "N", "Greatest force norm of a hold, in weights (1e6)", [&](const auto& text) {
        question.force_cap =
            read_number("--force-cap", text, "a number of weights, must be above 0 and at most 1e9",
                        [](double cap) { return cap > 0 && cap <= 1e9; });
      });
}

void Flags::search(Question& question, bool sturdy) {
  const bool is_turn = question.command == Command::turn;
  domain(question);
  objective(question, sturdy);
  force_cap(question);
  value("--gap", "PART",
        "Space: how far what is needed may be above the proven bound (" +
            std::string(is_turn ? "1e-3" : "1e-6") + ")",
        [&](const auto& text) {
          question.gap =
              read_number("--gap", text, "a part of the effort, must be above 0 and below 1",
                          [](double gap) { return gap > 0 && gap < 1; });
        });
  value("--max-holds", "N",
        "Space: holds to spend on the proof (" + std::string(is_turn ? "5000" : "2000") + ")",
        [&](const auto& text) {
          question.max_holds = static_cast<int>(
              read_number("--max-holds", text, "a number of holds, must be from 1 to 1000000",
                          [](double n) { return n >= 1 && n <= 1e6 && n == std::floor(n); }));
        });
}

void Flags::turned(Question& question) {
  value("--tilt-from", "X,Y,Z", "Space: choose from postures near this one", [&](const auto& text) {
    const auto v = read_direction("--tilt-from", text, 3, 3, "0,0,1");
    question.tilt_from = Vector<3>(v.data()).stableNormalized();
  });
  value("--tilt-max", "DEG", "Space: at most so far from it, 0 to 90", [&](const auto& text) {
    question.tilt_max_deg = read_number("--tilt-max", text, "an angle from 0 to 90 degrees",
                                        [](double angle) { return angle >= 0 && angle <= 90; });
  });
  value("--orientation", "W,X,Y,Z", "Space: how the object is turned now, object to world, +z up",
        [&](const auto& text) { question.orientation = read_quaternion("--orientation", text); });
}

void Flags::read() const {
  for (const auto& reader : readers_) reader();
}

}  // namespace poise
