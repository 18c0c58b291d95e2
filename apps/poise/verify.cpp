#include "verify.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "files/field.hpp"
#include "files/json_text.hpp"
#include "files/text.hpp"
#include "verify/verify.hpp"

namespace poise {
namespace {

using Json = nlohmann::ordered_json;

/// Claims that are true or not have nothing to measure.
std::string number(verify::Real value) {
  return value == 0 ? "0" : fmt::format("{:.2g}", static_cast<double>(value));
}

std::string place(const std::string& path) { return path.empty() ? "the document" : path; }

/// The line in which a claim stands in the document.
int line_of(const verify::Refutation& refutation, const Document& result) {
  return Field(result).follow(refutation.path).place().line;
}

std::string document(const verify::Verdict& claims, const Document& result) {
  Json checks = Json::array(), refuted = Json::array(), unchecked = Json::array();
  for (const verify::Unchecked& each : claims.unchecked())
    unchecked.push_back({{"where", each.where}, {"why", each.words}});
  for (const verify::Check& check : claims.checks())
    checks.push_back({{"claim", check.words},
                      {"where", check.where},
                      {"times", check.times},
                      {"off", static_cast<double>(check.off)},
                      {"allowed", static_cast<double>(check.allowed)},
                      {"closest", check.closest}});
  for (const verify::Refutation& each : claims.refutations())
    refuted.push_back({{"claim", each.words},
                       {"path", each.path},
                       {"line", line_of(each, result)},
                       {"off", static_cast<double>(each.off)},
                       {"allowed", static_cast<double>(each.allowed)}});
  return json_text({{"poise_result", 1},
                    {"command", "verify"},
                    {"options", Json::object()},
                    {"confirmed", claims.confirmed()},
                    {"open", claims.is_open()},
                    {"refuted", std::move(refuted)},
                    {"checks", std::move(checks)},
                    {"unchecked", std::move(unchecked)},
                    {"notes", claims.notes()}});
}

std::string report(const verify::Verdict& claims, const Document& result, const Style& style) {
  int times = 0;
  // The same claim is made at many places: the one closest to being refuted stands for all.
  std::vector<verify::Check> rows;
  for (const verify::Check& check : claims.checks()) {
    times += check.times;
    const auto same = [&](const verify::Check& row) { return row.words == check.words; };
    const auto row = std::find_if(rows.begin(), rows.end(), same);
    if (row == rows.end()) {
      rows.push_back(check);
      continue;
    }
    const int count = row->times + check.times;
    if (check.off * row->allowed > row->off * check.allowed || check.off > check.allowed)
      *row = check;
    row->times = count;
  }
  Table table({"<what was checked", "times", "off by", "allowed", "<at"});
  for (const verify::Check& row : rows) {
    const bool measured = row.allowed > 0;
    table.add({row.words, std::to_string(row.times),
               measured      ? number(row.off)
               : row.off > 0 ? "wrong"
                             : "right",
               measured ? number(row.allowed) : "", measured ? place(row.closest) : ""});
  }
  std::string text = table.text(style);
  for (const verify::Unchecked& each : claims.unchecked())
    text += "\n" + wrapped("Not checked: " + each.where + " (" + each.words + ").");
  for (const std::string& note : claims.notes()) text += "\n" + wrapped(note);
  if (claims.confirmed())
    return text + "\n" +
           style.bold(fmt::format("Confirmed: all {} claims of {}.", times, shown(result.file))) +
           "\n";
  text += "\n" + style.bold("Refuted") + "\n";
  constexpr std::size_t most = 20;
  const auto& refuted = claims.refutations();
  for (std::size_t k = 0; k < std::min(most, refuted.size()); ++k) {
    const verify::Refutation& each = refuted[k];
    text += fmt::format("  line {}, {}: {}", line_of(each, result), place(each.path), each.words);
    if (each.allowed > 0)
      text += fmt::format(": off by {}, allowed {}", number(each.off), number(each.allowed));
    text += "\n";
  }
  if (refuted.size() > most) text += fmt::format("  and {} more\n", refuted.size() - most);
  return text;
}

}  // namespace

Verdict verdict(const GraspFile& grasp, const std::string& result, bool json, const Style& style) {
  const Document read = parse_json(read_text(result, max_result), file_name(result), max_result);
  const verify::Verdict claims = verify::verify(grasp, read);
  return {json ? document(claims, read) : report(claims, read, style), claims.confirmed(),
          claims.is_open()};
}

}  // namespace poise
