#include "batch/candidates.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>

#include "files/csv.hpp"
#include "files/degrees.hpp"
#include "files/json_value.hpp"
#include "files/text.hpp"
#include "poise/grip.hpp"

namespace poise {
namespace {

/// A file of candidates holds no more [bytes].
constexpr std::size_t longest_file = std::size_t{1} << 28U;

using Columns = std::vector<std::size_t>;

/// The columns of these names; none where all are missing.
std::optional<Columns> columns(const CsvReader& reader, const std::string& file,
                               const std::vector<const char*>& names) {
  Columns found;
  std::string missing;
  for (const char* const name : names) {
    const auto column = reader.column(name);
    if (column)
      found.push_back(*column);
    else
      missing += (missing.empty() ? "" : ", ") + std::string(name);
  }
  if (found.empty()) return {};
  if (!missing.empty()) throw FileError(file, {1, 1}, "header", "lacks the column " + missing);
  return found;
}

/// Numbers of a row that are not all 0.
Eigen::VectorXd direction(const CsvReader& reader, const std::vector<Cell>& row,
                          const Columns& columns, const char* what) {
  Eigen::VectorXd numbers(static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k)
    numbers[static_cast<Eigen::Index>(k)] = reader.number(row, columns[k]);
  if (numbers.isZero(0))
    reader.fail(row[columns.front()], columns.front(),
                std::string("is 0 as all of the ") + what + ", which has no length");
  return numbers.stableNormalized();
}

/// So that values within about 1e-6 of each other are mostly one.
double coarse(double value) {
  if (!std::isfinite(value) || value == 0) return value;
  int exponent = 0;
  const double part = std::frexp(value, &exponent);
  return std::ldexp(std::round(std::ldexp(part, 20)), exponent - 20);
}

std::optional<double> finite(double number) {
  return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

}  // namespace

template <int Dim>
Candidates<Dim> read_candidates(const std::string& file) {
  const std::string name = file_name(file), text = read_text(file, longest_file);
  if (text.size() > longest_file) throw FileError(name, {}, "", "is longer than 256 MB: split it");
  CsvReader reader(text, name);
  std::optional<Columns> quaternion, up, angle;
  if constexpr (Dim == 3) {
    quaternion = columns(reader, name, {"qw", "qx", "qy", "qz"});
    if (!quaternion) quaternion = columns(reader, name, {"w", "x", "y", "z"});
    if (!quaternion) up = columns(reader, name, {"up_x", "up_y", "up_z"});
    if (!quaternion && !up)
      throw FileError(
          name, {1, 1}, "header",
          "must have the columns w, x, y, z (or qw, qx, qy, qz) of a quaternion, object "
          "to world, or up_x, up_y, up_z");
  } else {
    angle = columns(reader, name, {"angle_deg"});
    if (!angle) up = columns(reader, name, {"up_x", "up_y"});
    if (!angle && !up)
      throw FileError(name, {1, 1}, "header", "must have the column angle_deg, or up_x, up_y");
  }
  const Columns& taken = quaternion ? *quaternion : up ? *up : *angle;
  Candidates<Dim> candidates;
  std::vector<std::size_t> others;
  for (std::size_t k = 0; k < reader.header().size(); ++k)
    if (std::find(taken.begin(), taken.end(), k) == taken.end()) {
      others.push_back(k);
      candidates.others.push_back(reader.header()[k]);
    }
  while (const auto row = reader.next()) {
    Candidate<Dim> candidate{.row = candidates.list.size() + 1};
    if constexpr (Dim == 3) {
      const Eigen::VectorXd v =
          direction(reader, *row, taken, quaternion ? "quaternion" : "direction");
      if (quaternion) candidate.orientation = Eigen::Quaterniond(v[0], v[1], v[2], v[3]);
      candidate.up = quaternion ? Vector<3>(candidate.orientation->conjugate() * Vector<3>::UnitZ())
                                : Vector<3>(v);
    } else if (angle) {
      candidate.angle_deg = reader.number(*row, angle->front());
      candidate.up = up_at(radians(*candidate.angle_deg));
    } else {
      candidate.up = direction(reader, *row, taken, "direction");
    }
    for (const std::size_t k : others) candidate.others.push_back((*row)[k].text);
    candidates.list.push_back(std::move(candidate));
  }
  if (candidates.list.empty())
    throw FileError(name, {1, 1}, "", "has a header and no rows: there is nothing to choose from");
  return candidates;
}

template <int Dim>
std::vector<RankedCandidate<Dim>> ranked(const FileOf<Dim>& file, const Grasp<Dim>& grasp,
                                         const Question& question,
                                         const Candidates<Dim>& candidates) {
  std::vector<RankedCandidate<Dim>> answers(candidates.list.size());
  const auto answer = [&](std::size_t k) {
    const Candidate<Dim>& candidate = candidates.list[k];
    Question own = question;
    own.command = Command::turn;
    own.with_turn = false;
    own.angle_deg = candidate.angle_deg;
    if (!own.angle_deg) own.up.assign(candidate.up.begin(), candidate.up.end());
    const auto turn = std::get<TurnAnswer<Dim>>(ask(file, grasp, own).of);
    RankedCandidate<Dim>& result = answers[k];
    result.candidate = &candidate;
    result.holdable = turn.then.holdable();
    const TurnPeak<Dim>& straight = turn.taken.straight;
    result.turn = straight.angle;
    result.peak = straight.peak;
    result.peak_lower_bound = straight.lower_bound;
    result.peak_at = straight.at;
    if (!result.holdable) return;
    result.manner = turn.then.manner;
    result.effort = turn.then.effort();
    if (!has_grip(grasp)) return;
    result.grip = 0;
    for (const Hold<Dim>& hold : turn.then.holds)
      result.grip = std::max(*result.grip, grip(grasp, hold));
  };
  using Range = oneapi::tbb::blocked_range<std::size_t>;
  oneapi::tbb::parallel_for(Range(0, answers.size(), 16), [&](const Range& range) {
    for (std::size_t k = range.begin(); k < range.end(); ++k) answer(k);
  });
  const bool by_grip = question.objective.value_or(file.objective) == Objective::grip;
  const auto key = [&](const RankedCandidate<Dim>& each) {
    const double value = by_grip && each.grip ? *each.grip : each.effort;
    return std::tuple(!each.holdable, coarse(value), coarse(each.peak), coarse(std::abs(each.turn)),
                      each.candidate->row);
  };
  std::sort(answers.begin(), answers.end(),
            [&](const auto& a, const auto& b) { return key(a) < key(b); });
  return answers;
}

template <int Dim>
std::string lines_of(const Candidates<Dim>& candidates,
                     const std::vector<RankedCandidate<Dim>>& ranked) {
  using Json = nlohmann::ordered_json;
  std::string lines;
  std::size_t rank = 0;
  const auto number = [](std::optional<double> value) { return value ? Json(*value) : Json(); };
  for (const RankedCandidate<Dim>& each : ranked) {
    const Candidate<Dim>& candidate = *each.candidate;
    Json line{{"rank", ++rank}, {"row", candidate.row}, {"up", json_value(candidate.up)}};
    if constexpr (Dim == 2) line["angle_deg"] = degrees(angle_of(candidate.up));
    if (const auto& q = candidate.orientation)
      line["orientation"] = {{"w", q->w()}, {"x", q->x()}, {"y", q->y()}, {"z", q->z()}};
    line["holdable"] = each.holdable;
    line["grip"] = number(each.grip);
    line["effort"] = each.holdable ? Json(each.effort) : Json();
    line["manner"] = each.holdable ? Json(to_string(each.manner)) : Json();
    line["turn_deg"] = degrees(each.turn);
    line["peak"] = number(finite(each.peak));
    line["peak_lower_bound"] = number(finite(each.peak_lower_bound));
    line["peak_at_deg"] = std::isfinite(each.peak) ? Json(degrees(each.peak_at)) : Json();
    Json columns = Json::object();
    for (std::size_t k = 0; k < candidates.others.size(); ++k)
      columns[candidates.others[k]] = candidate.others[k];
    line["columns"] = std::move(columns);
    lines += line.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  }
  return lines;
}

#define POISE_CANDIDATES(Dim)                                                                 \
  template Candidates<Dim> read_candidates(const std::string&);                               \
  template std::vector<RankedCandidate<Dim>> ranked(const FileOf<Dim>&, const Grasp<Dim>&,    \
                                                    const Question&, const Candidates<Dim>&); \
  template std::string lines_of(const Candidates<Dim>&, const std::vector<RankedCandidate<Dim>>&);
POISE_CANDIDATES(2)
POISE_CANDIDATES(3)
#undef POISE_CANDIDATES

}  // namespace poise
