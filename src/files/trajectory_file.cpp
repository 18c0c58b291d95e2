#include "files/trajectory_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "files/csv.hpp"
#include "files/text.hpp"
#include "shape/number_text.hpp"

namespace poise {
namespace {

/// A trajectory is no longer [bytes].
constexpr std::size_t longest_file = std::size_t{1} << 28U;
constexpr double most_off = 0.1, some_off = 1e-3;  // of the length of a quaternion
constexpr double gap = 10;                         // a step is one at so many median steps
constexpr double fast = 100 * standard_gravity;    // no arm accelerates like this [m/s^2]
constexpr double spinning = 200;                   // nor turns like this [rad/s]

/// Columns of these names.
template <std::size_t Size>
std::optional<std::array<std::size_t, Size>> columns(const CsvReader& reader,
                                                     const std::string& file,
                                                     const std::array<const char*, Size>& names,
                                                     const std::string& what) {
  std::array<std::size_t, Size> found{};
  std::size_t count = 0;
  std::string missing;
  for (const char* const name : names)
    if (const auto column = reader.column(name))
      found[count++] = *column;
    else
      missing += (missing.empty() ? "" : ", ") + std::string(name);
  if (count == 0 && what.empty()) return {};
  if (count < Size) throw FileError(file, {1, 1}, "header", "lacks the column " + missing + what);
  return found;
}

/// Reads the rows one after the other.
class Rows {
 public:
  Rows(CsvReader& reader, std::string file)
      : reader_(reader),
        file_(std::move(file)),
        time_(columns<1>(reader, file_, {"t"}, ", the time in seconds")->front()),
        position_(*columns<3>(reader, file_, {"x", "y", "z"}, ", the position in metres")),
        quaternion_(*columns<4>(reader, file_, {"qw", "qx", "qy", "qz"},
                                ": orientations are quaternions, object to world, not angles")),
        acceleration_(columns<3>(reader, file_, {"ax", "ay", "az"}, "")) {}

  TrajectoryFile read() {
    Trajectory& to = read_.trajectory;
    while (const auto row = reader_.next()) {
      const double time = reader_.number(*row, time_);
      if (!to.times.empty() && !(time > to.times.back()))
        reader_.fail((*row)[time_], time_,
                     "is " + number_text(time) + ", must be above that of the row before, " +
                         number_text(to.times.back()));
      to.times.push_back(time);
      to.positions.push_back(vector(*row, position_));
      to.orientations.push_back(orientation(*row));
      if (acceleration_) to.accelerations.push_back(vector(*row, *acceleration_));
      read_.lines.push_back(row->front().place.line);
    }
    if (to.times.empty())
      throw FileError(file_, {1, 1}, "", "has a header and no rows: nothing moves");
    warn_of_gaps();
    return std::move(read_);
  }

 private:
  Vector<3> vector(const std::vector<Cell>& row, const std::array<std::size_t, 3>& at) const {
    return {reader_.number(row, at[0]), reader_.number(row, at[1]), reader_.number(row, at[2])};
  }

  Eigen::Quaterniond orientation(const std::vector<Cell>& row) {
    Eigen::Vector4d v;
    for (std::size_t k = 0; k < 4; ++k)
      v[static_cast<Eigen::Index>(k)] = reader_.number(row, quaternion_[k]);
    const double length = v.stableNorm(), off = std::abs(length - 1);
    if (!(off <= most_off))
      reader_.fail(row[quaternion_[0]], quaternion_[0],
                   "begins a quaternion of length " + number_text(length) + ", must be 1" +
                       (length > 2 ? ": are these angles in degrees?" : ""));
    if (off > some_off && !is_off_) {
      is_off_ = true;
      read_.warnings.push_back(located(
          file_, row[quaternion_[0]].place,
          "row " + std::to_string(read_.trajectory.times.size()) + ", column qw",
          "begins a quaternion of length " + number_text(length) + ": it is made of length 1"));
    }
    return {v[0], v[1], v[2], v[3]};
  }

  void warn_of_gaps() {
    const std::vector<double>& t = read_.trajectory.times;
    if (t.size() < 4) return;
    std::vector<double> steps(t.size() - 1);
    for (std::size_t k = 0; k < steps.size(); ++k) steps[k] = t[k + 1] - t[k];
    std::vector<double> sorted = steps;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const auto longest = std::max_element(steps.begin(), steps.end());
    if (!(*longest > gap * *middle)) return;
    const auto count = std::count_if(steps.begin(), steps.end(),
                                     [&](double step) { return step > gap * *middle; });
    const auto row = static_cast<std::size_t>(longest - steps.begin()) + 1;
    read_.warnings.push_back(
        located(file_, {read_.lines[row], 1}, "row " + std::to_string(row + 1) + ", column t",
                "comes " + number_text(*longest) + " s after the row before, where " +
                    number_text(*middle) + " s is usual" +
                    (count > 1 ? " (one of " + std::to_string(count) + " such gaps)" : "") +
                    ": what happens between is not known"));
  }

  CsvReader& reader_;
  std::string file_;
  std::size_t time_;
  std::array<std::size_t, 3> position_;
  std::array<std::size_t, 4> quaternion_;
  std::optional<std::array<std::size_t, 3>> acceleration_;
  TrajectoryFile read_{};
  bool is_off_{false};
};

}  // namespace

TrajectoryFile read_trajectory(const std::string& file) {
  const std::string name = file_name(file), text = read_text(file, longest_file);
  if (text.size() > longest_file) throw FileError(name, {}, "", "is longer than 256 MB: split it");
  CsvReader reader(text, name);
  return Rows(reader, name).read();
}

std::vector<std::string> doubts(const TrajectoryFile& read, const std::vector<MotionState>& states,
                                const std::string& file) {
  std::vector<std::string> lines;
  const auto add = [&](auto value, double most, const std::string& column, const char* unit,
                       const char* question) {
    const auto worst = std::max_element(
        states.begin(), states.end(),
        [&](const MotionState& a, const MotionState& b) { return value(a) < value(b); });
    if (!(value(*worst) > most)) return;
    const auto row = static_cast<std::size_t>(worst - states.begin());
    lines.push_back(
        located(file_name(file), {read.lines[row], 1},
                "row " + std::to_string(row + 1) + ", column " + column,
                std::string(question) + " There it comes to " + number_text(value(*worst)) + unit));
  };
  add([](const MotionState& state) { return state.acceleration.norm(); }, fast,
      read.trajectory.accelerations.empty() ? "x" : "ax", " m/s2",
      "are positions in metres and times in seconds, without noise?");
  add([](const MotionState& state) { return state.angular_velocity.norm(); }, spinning, "qw",
      " rad/s", "are times in seconds, and do the quaternions belong together?");
  return lines;
}

}  // namespace poise
