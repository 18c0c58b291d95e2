#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>

#include "files/text.hpp"
#include "files/value.hpp"

namespace poise {
namespace {

/// Values in a value, itself included, and its depth.
struct Extent {
  std::size_t values{1};
  int depth{0};
};

Extent extent(const Value& value) {
  Extent all;
  const auto add = [&](const Value& part) {
    const Extent inner = extent(part);
    all.values += inner.values;
    all.depth = std::max(all.depth, inner.depth + 1);
  };
  if (const auto* list = std::get_if<List>(&value.data))
    for (const Value& part : *list) add(part);
  if (const auto* mapping = std::get_if<Mapping>(&value.data))
    for (const Member& member : *mapping) add(member.value);
  return all;
}

/// Builds the value of a document from the events of the parser.
class Builder : public YAML::EventHandler {
 public:
  explicit Builder(const Document& document) : document_(document) {}

  Value root{};
  /// The first key that is not text. To be refused last: the parser takes what follows a bracket
  /// that is never closed for a key.
  std::optional<std::size_t> odd_key{};

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (documents_++ > 0) fail(mark, "a second document begins here, must be one");
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    // Where nothing is written after a key, the mark is that of what comes next.
    const bool of_key = !open_.empty() && open_.back().has_key;
    add({{}, of_key ? open_.back().key_at : at(mark)}, anchor);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& text) override {
    if (wants_key() && text == "<<" && tag == "?")
      fail(mark, "merge keys are not part of YAML 1.2, write the keys out");
    const std::string core = "tag:yaml.org,2002:";
    // "?" is the tag of plain scalars, "!" that of quoted ones.
    if (tag.empty() || tag == "?" || tag == core + "null" || tag == core + "bool" ||
        tag == core + "int" || tag == core + "float")
      add(wants_key() ? Value{text, at(mark)} : plain_scalar(text, at(mark)), anchor);
    else if (tag == "!" || tag == core + "str")
      add({text, at(mark)}, anchor);
    else
      refuse_tag(mark, tag);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value /*style*/) override {
    open(mark, tag, "seq", {List{}, at(mark)}, anchor);
  }
  void OnSequenceEnd() override { close(); }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value /*style*/) override {
    open(mark, tag, "map", {Mapping{}, at(mark)}, anchor);
  }
  void OnMapEnd() override { close(); }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto anchored = anchors_.find(anchor);
    if (anchored == anchors_.end()) fail(mark, "an alias within the value that it stands for");
    const Extent size = extent(anchored->second);
    if (static_cast<int>(open_.size()) + size.depth > max_depth) fail(mark, "is nested too deeply");
    count(size.values, mark);
    add(anchored->second, YAML::NullAnchor);
  }

 private:
  /// A list or mapping that has begun and not ended; of a mapping the key that waits for its value.
  struct Open {
    Value value;
    YAML::anchor_t anchor;
    bool has_key{false};
    std::string key{};
    std::size_t key_at{0};
  };

  static std::size_t at(const YAML::Mark& mark) {
    return mark.pos < 0 ? 0 : static_cast<std::size_t>(mark.pos);
  }

  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& problem) const {
    document_.fail(at(mark), problem);
  }

  [[noreturn]] void refuse_tag(const YAML::Mark& mark, const std::string& tag) const {
    fail(mark, "has the tag " + shown(tag) + ", must have none");
  }

  bool wants_key() const {
    return !open_.empty() && std::holds_alternative<Mapping>(open_.back().value.data) &&
           !open_.back().has_key;
  }

  void count(std::size_t values, const YAML::Mark& mark) {
    values_ += values;
    if (values_ > max_values) fail(mark, "too many values, once aliases are written out");
  }

  void open(const YAML::Mark& mark, const std::string& tag, const std::string& kind, Value value,
            YAML::anchor_t anchor) {
    if (!tag.empty() && tag != "?" && tag != "!" && tag != "tag:yaml.org,2002:" + kind)
      refuse_tag(mark, tag);
    if (static_cast<int>(open_.size()) > max_depth) fail(mark, "is nested too deeply");
    open_.push_back({std::move(value), anchor});
  }

  void close() {
    Open done = std::move(open_.back());
    open_.pop_back();
    add(std::move(done.value), done.anchor);
  }

  void add(Value value, YAML::anchor_t anchor) {
    if (anchor != YAML::NullAnchor) {
      // The copy counts: anchors may be nested as well as aliases.
      values_ += extent(value).values;
      if (values_ > max_values)
        document_.fail(value.at, "too many values, once aliases are written out");
      anchors_[anchor] = value;
    }
    if (open_.empty()) {
      root = std::move(value);
    } else if (auto* list = std::get_if<List>(&open_.back().value.data)) {
      list->push_back(std::move(value));
    } else if (Open& mapping = open_.back(); mapping.has_key) {
      std::get<Mapping>(mapping.value.data)
          .push_back({mapping.key, mapping.key_at, std::move(value)});
      mapping.has_key = false;
    } else {
      const auto* key = std::get_if<std::string>(&value.data);
      if (!key && !odd_key) odd_key = value.at;
      mapping.has_key = true;
      mapping.key = key ? *key : "";
      mapping.key_at = value.at;
    }
  }

  const Document& document_;
  std::vector<Open> open_{};
  std::map<YAML::anchor_t, Value> anchors_{};
  std::size_t values_{0};
  int documents_{0};
};

bool tab_in_indentation(const std::string& text, std::size_t at) {
  const std::size_t line = at == 0 ? 0 : text.find_last_of("\r\n", at - 1) + 1;
  const std::size_t end = std::min(text.find_first_not_of(" \t", line), text.size());
  return text.substr(line, end - line).find('\t') != std::string::npos;
}

}  // namespace

Document parse_yaml(std::string text, const std::string& file) {
  const std::size_t first = text.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  if (first != std::string::npos && text[first] == '{') {
    try {
      return parse_json(text, file);
    } catch (const FileError&) {
      // YAML may begin with a brace too.
    }
  }
  Document document = open_document(std::move(text), file);
  Builder builder(document);
  try {
    // Without the line end: yaml-cpp lets quotes go unclosed where the text ends with one.
    std::istringstream in(document.text.substr(0, document.text.find_last_not_of(" \t\r\n") + 1));
    YAML::Parser parser(in);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& error) {
    const std::size_t at = error.mark.pos < 0 ? 0 : static_cast<std::size_t>(error.mark.pos);
    document.fail(
        at, "is not YAML: " + error.msg +
                (tab_in_indentation(document.text, at) ? " (the line is indented by a tab)" : ""));
  }
  if (builder.odd_key) document.fail(*builder.odd_key, "is a key, must be text");
  document.root = std::move(builder.root);
  return document;
}

}  // namespace poise
