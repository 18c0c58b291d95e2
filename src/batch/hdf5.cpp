#include "batch/hdf5.hpp"

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <system_error>

#include "files/file_error.hpp"
#include "readers/readers.hpp"

namespace poise {
namespace {

using Json = nlohmann::json;
using Arrays = std::vector<NamedArray>;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// The postures of one kind in all records of a data file; null where there is none.
void add_postures(Arrays& arrays, const std::string& kind, const std::vector<Json>& holds) {
  NamedArray up{kind + "_up", 3, {}, {{"units", "1"}}};
  NamedArray effort{kind + "_effort", 1, {}, {{"units", "N^2"}}};
  NamedArray normal{kind + "_normal_force", 1, {}, {{"units", "N"}}};
  std::string labels;
  for (const Json& hold : holds) {
    if (!hold.contains("fingers")) continue;
    normal.width = hold["fingers"].size();
    for (const Json& finger : hold["fingers"])
      labels += (labels.empty() ? "" : ",") + finger["finger"].get<std::string>();
    break;
  }
  normal.attributes.emplace_back("fingers", labels);
  for (const Json& hold : holds) {
    const bool held = hold.contains("fingers");
    for (std::size_t k = 0; k < 3; ++k)
      up.values.push_back(held ? hold["up"][k].get<double>() : none);
    effort.values.push_back(held ? hold["effort"].get<double>() : none);
    for (std::size_t k = 0; k < normal.width; ++k)
      normal.values.push_back(held ? hold["fingers"][k]["normal_force"].get<double>() : none);
  }
  arrays.insert(arrays.end(), {std::move(up), std::move(effort), std::move(normal)});
}

/// The records of one data file.
Arrays arrays_of(const std::vector<Json>& records) {
  NamedArray holdable{"holdable", 1, {}, {{"values", "1: holdable, 0: unholdable, -1: bad"}}, true};
  std::vector<Json> best, pinched, hold;
  for (const Json& record : records) {
    const bool bad = record.contains("error"), one = record.contains("holdable");
    best.push_back(record.value("best", Json()));
    pinched.push_back(record.value("best_pinched", Json()));
    if (one) hold.resize(best.size());  // null where a grasp is bad
    if (one) hold.back() = record;
    const bool held = one ? record["holdable"].get<bool>() : !best.back().is_null();
    holdable.values.push_back(bad ? -1 : held);
  }
  Arrays arrays{std::move(holdable)};
  if (!hold.empty()) {
    hold.resize(records.size());
    add_postures(arrays, "hold", hold);
    return arrays;
  }
  add_postures(arrays, "best", best);
  add_postures(arrays, "best_pinched", pinched);
  return arrays;
}

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
  const Part part(path + ".part");
  std::ifstream in(records, std::ios::binary);
  std::string file;
  std::vector<Json> same;
  const auto add = [&] {
    if (same.empty()) return;
    add_arrays(part.path, std::filesystem::path(file).stem().string(), arrays_of(same));
    same.clear();
  };
  try {
    for (std::string line; std::getline(in, line);) {
      Json record = Json::parse(line);
      if (record.at("file") != file) add();
      file = record["file"];
      same.push_back(std::move(record));
    }
    add();
  } catch (const WriteError& error) {
    throw FileError(path, {}, "", error.what());
  }
  if (std::rename(part.path.c_str(), path.c_str()) != 0)
    throw FileError(path, {}, "", "cannot be written: " + std::generic_category().message(errno));
}

}  // namespace poise
