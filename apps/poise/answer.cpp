#include "answer.hpp"

#include <cstdio>
#include <map>

#include "ask/document.hpp"
#include "shape/characters.hpp"
#include "tables/report.hpp"

namespace poise {

void warn(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings)
    std::fputs(("poise: " + harmless(warning) + "\n").c_str(), stderr);
}

UsageError usage_error(const Misfit& misfit, const std::string& file) {
  const std::map<std::string, std::string> advice = {
      {"angle", ": give --up X,Y,Z"},
      {"curve", ", where postures make no curve: ask for best"},
      {"domain", ", where best_pinched is shown anyway"}};
  const std::string& option = misfit.option();
  const auto more = advice.find(option);
  return UsageError((option == "curve" ? "" : "--") + option + ": " + misfit.problem() + " " +
                    file +
                    (misfit.dimension() == 2   ? " is in the plane (dimension 2)"
                     : misfit.dimension() == 3 ? " is in space (dimension 3)"
                                               : "") +
                    (more == advice.end() ? "" : more->second));
}

std::shared_ptr<Asked> declare_question(Flags& flags, Command command) {
  auto asked = std::make_shared<Asked>();
  asked->question.command = command;
  flags.grasp_file(asked->file);
  flags.json(asked->json);
  return asked;
}

namespace {

template <int Dim>
Reply reply(const Asked& asked, const FileOf<Dim>& file, const Grasp<Dim>& grasp) {
  if (asked.question.command != Command::check) warn(file.warnings);
  const AnswerTo<Dim> answer = ask(file, grasp, asked.question);
  const auto table = [&](const auto& own) { return report(file, grasp, own, style_of_output()); };
  return {asked.json ? document(file, grasp, answer) : std::visit(table, answer.of),
          holdable(answer), proven(answer)};
}

}  // namespace

Reply answer(const Asked& asked, const PlanarFile& file, const Grasp<2>& grasp) {
  return reply<2>(asked, file, grasp);
}

Reply answer(const Asked& asked, const SpatialFile& file, const Grasp<3>& grasp) {
  return reply<3>(asked, file, grasp);
}

Reply answer(const Asked& asked) {
  return with_grasp(
      asked.file, [&](const auto& file, const auto& grasp) { return answer(asked, file, grasp); });
}

}  // namespace poise
