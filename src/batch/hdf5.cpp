#include "batch/hdf5.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <system_error>

#include "files/output.hpp"
#include "readers/readers.hpp"

namespace poise {
namespace {

using Json = nlohmann::json;
using Arrays = std::vector<NamedArray>;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// The postures of one kind in all records of a data file.
class Postures {
 public:
  explicit Postures(const std::string& kind)
      : up_{kind + "_up", 3, {}, {{"units", "1"}}},
        effort_{kind + "_effort", 1, {}, {{"units", "N^2"}}},
        normal_{kind + "_normal_force", 1, {}, {{"units", "N"}}} {}

  /// That of the next record; null, or without fingers, where there is none.
  void add(const Json& hold) {
    const bool held = hold.contains("fingers");
    if (held && fingers_.empty()) name_fingers(hold["fingers"]);
    for (std::size_t k = 0; k < 3; ++k)
      up_.values.push_back(held ? hold["up"][k].get<double>() : none);
    effort_.values.push_back(held ? hold["effort"].get<double>() : none);
    for (std::size_t k = 0; k < normal_.width; ++k)
      normal_.values.push_back(held ? hold["fingers"][k]["normal_force"].get<double>() : none);
  }

  void move_to(Arrays& arrays) {
    normal_.attributes.emplace_back("fingers", fingers_);
    arrays.insert(arrays.end(), {std::move(up_), std::move(effort_), std::move(normal_)});
  }

 private:
  void name_fingers(const Json& fingers) {
    for (const Json& finger : fingers)
      fingers_ += (fingers_.empty() ? "" : ",") + finger["finger"].get<std::string>();
    normal_.width = fingers.size();
    normal_.values.assign(normal_.width * effort_.values.size(), none);
  }

  NamedArray up_, effort_, normal_;
  std::string fingers_;
};

/// The records of one data file.
class FileArrays {
 public:
  void add(const Json& record) {
    const bool bad = record.contains("error"), one = record.contains("holdable");
    const Json best = record.value("best", Json());
    best_.add(best);
    pinched_.add(record.value("best_pinched", Json()));
    hold_.add(one ? record : Json());
    of_holds_ = of_holds_ || one;
    const bool held = one ? record["holdable"].get<bool>() : !best.is_null();
    holdable_.values.push_back(bad ? -1 : held);
  }
  bool empty() const { return holdable_.values.empty(); }

  Arrays arrays() && {
    Arrays arrays{std::move(holdable_)};
    if (of_holds_) {
      hold_.move_to(arrays);
    } else {
      best_.move_to(arrays);
      pinched_.move_to(arrays);
    }
    return arrays;
  }

 private:
  NamedArray holdable_{
      "holdable", 1, {}, {{"values", "1: holdable, 0: unholdable, -1: bad"}}, true};
  Postures best_{"best"}, pinched_{"best_pinched"}, hold_{"hold"};
  bool of_holds_{false};
};

/// A file that becomes another one, or vanishes.
struct Part {
  std::string path;
  explicit Part(std::string part) : path(std::move(part)) { std::remove(path.c_str()); }
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;
  ~Part() { std::remove(path.c_str()); }
};

}  // namespace

void write_hdf5(const std::string& records, const std::string& path) {
  const Target target = target_of(path);
  const Part part(target.path + "." + std::to_string(getpid()) + ".part");
  std::ifstream in(records, std::ios::binary);
  std::string file;
  FileArrays same;
  const auto write = [&] {
    if (same.empty()) return;
    add_arrays(part.path, std::filesystem::path(file).stem().string(), std::move(same).arrays());
    same = {};
  };
  try {
    for (std::string line; std::getline(in, line);) {
      const Json record = Json::parse(line);
      if (!record.contains("grasp")) continue;  // of a file of which nothing is known
      if (record.at("file") != file) write();
      file = record["file"];
      same.add(record);
    }
    write();
  } catch (const WriteError& error) {
    throw FileError(path, {}, "", error.what());
  }
  if (std::rename(part.path.c_str(), target.path.c_str()) != 0)
    throw FileError(path, {}, "", "cannot be written: " + std::generic_category().message(errno));
}

}  // namespace poise
