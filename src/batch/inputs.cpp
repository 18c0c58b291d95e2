#include "batch/inputs.hpp"

#include <algorithm>
#include <cerrno>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <system_error>
#include <vector>

#include "readers/input.hpp"

namespace poise {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Size and time of the last change.
Json state_of(const fs::path& path) {
  return {{"path", path.string()},
          {"bytes", fs::file_size(path)},
          {"changed", fs::last_write_time(path).time_since_epoch().count()}};
}

/// @throws FileError unless it is a file that has an end
void check(const std::string& path) {
  try {
    check_input(path);
  } catch (const ReadError& error) {
    throw FileError(path, {}, "", error.what());
  }
}

class JsonLines : public Inputs {
 public:
  explicit JsonLines(std::string path) : path_(std::move(path)) {
    if (path_ == "-") {
      note_input(path_);
      return;
    }
    check(path_);
    errno = 0;
    file_.open(path_, std::ios::binary);
    if (!file_)
      throw FileError(path_, {}, "", "cannot be opened: " + std::generic_category().message(errno));
    bytes_ = static_cast<double>(fs::file_size(path_));
  }

  std::optional<Unread> next() override {
    std::string line;
    if (!read_line(line)) return {};
    return Unread{{}, [line = std::move(line)] { return grasp_of_line(line); }};
  }
  double part() const override { return bytes_ > 0 ? read_ / bytes_ : -1; }
  Json identity() const override { return path_ == "-" ? Json(path_) : state_of(path_); }

 private:
  /// Of a line that is too long only so much that this can be seen.
  bool read_line(std::string& line) {
    std::streambuf& in = *(path_ == "-" ? std::cin : file_).rdbuf();
    constexpr int end = std::char_traits<char>::eof();
    int c = in.sbumpc();
    if (c == end) return false;
    for (; c != end; c = in.sbumpc()) {
      ++read_;
      if (c == '\n') return true;
      if (line.size() <= longest_line) line += static_cast<char>(c);
    }
    return true;
  }

  std::string path_;
  std::ifstream file_;
  double bytes_{0}, read_{0};
};

class Folder : public Inputs {
 public:
  explicit Folder(std::string path) : path_(std::move(path)) {
    std::error_code error;
    for (fs::directory_iterator at(path_, error), end; !error && at != end; at.increment(error)) {
      const std::string name = at->path().filename();
      if (name.starts_with('.')) continue;  // hidden: editors and file systems leave such
      if (!has_ending(name, ".yaml") && !has_ending(name, ".yml") && !has_ending(name, ".json"))
        continue;
      names_.push_back(name);
      note_input(at->path());
    }
    if (error) throw FileError(path_, {}, "", "cannot be read: " + error.message());
    if (names_.empty())
      throw FileError(path_, {}, "", "holds no grasp files (.yaml, .yml or .json)");
    std::sort(names_.begin(), names_.end());
  }

  std::optional<Unread> next() override {
    if (records_ == names_.size()) return {};
    const std::string& name = names_[records_++];
    return Unread{{.file = name},
                  [file = (fs::path(path_) / name).string()] { return read_grasp_file(file); }};
  }
  double part() const override {
    return static_cast<double>(records_) / static_cast<double>(names_.size());
  }
  Json identity() const override { return {{"path", path_}, {"files", names_}}; }

 private:
  std::string path_;
  std::vector<std::string> names_;
  std::size_t records_{0};
};

/// A file of the ACRONYM data set, open from its first grasp to its last. One of which it is not
/// known how many grasps it has is a single bad record.
class AcronymFile : public Inputs {
 public:
  AcronymFile(std::string path, std::string mesh_root)
      : path_(std::move(path)), mesh_root_(std::move(mesh_root)) {
    check(path_);
  }

  std::optional<Unread> next() override {
    if (ended_) return {};
    try {
      if (!data_) data_ = std::make_shared<const Acronym>(path_, mesh_root_);
    } catch (const std::exception&) {
      ended_ = true;
      RecordKey key = key_of_acronym(path_, 0);
      key.grasp.reset();
      return Unread{std::move(key), [error = std::current_exception()]() -> GraspFile {
                      std::rethrow_exception(error);
                    }};
    }
    if (grasps_ < data_->size()) {
      const std::size_t n = grasps_++;
      return Unread{key_of_acronym(path_, n),
                    [data = data_, n] { return grasp_of_acronym(*data, n); }};
    }
    data_.reset();
    ended_ = true;
    return {};
  }
  double part() const override {
    return data_ ? static_cast<double>(grasps_) / static_cast<double>(data_->size()) : ended_;
  }
  Json identity() const override {
    Json result = state_of(path_);
    result["mesh_root"] = mesh_root_;
    return result;
  }

 private:
  std::string path_, mesh_root_;
  std::shared_ptr<const Acronym> data_;
  std::size_t grasps_{0};
  bool ended_{false};
};

class Several : public Inputs {
 public:
  void add(std::unique_ptr<Inputs> inputs) { list_.push_back(std::move(inputs)); }

  std::optional<Unread> next() override {
    for (; at_ < list_.size(); ++at_)
      if (auto unread = list_[at_]->next()) return unread;
    return {};
  }
  double part() const override {
    if (at_ == list_.size()) return 1;
    const double part = list_[at_]->part();
    return part < 0 ? -1 : (static_cast<double>(at_) + part) / static_cast<double>(list_.size());
  }
  Json identity() const override {
    Json result = Json::array();
    for (const auto& inputs : list_) result.push_back(inputs->identity());
    return result;
  }

 private:
  std::vector<std::unique_ptr<Inputs>> list_;
  std::size_t at_{0};
};

std::unique_ptr<Inputs> open_input(const std::string& path, const std::string& mesh_root) {
  if (has_ending(path, ".h5")) return std::make_unique<AcronymFile>(path, mesh_root);
  if (path != "-" && fs::is_directory(path)) return std::make_unique<Folder>(path);
  return std::make_unique<JsonLines>(path);
}

}  // namespace

std::unique_ptr<Inputs> open_inputs(const std::vector<std::string>& paths,
                                    const std::string& mesh_root) {
  auto all = std::make_unique<Several>();
  for (const std::string& path : paths) all->add(open_input(path, mesh_root));
  return all;
}

}  // namespace poise
