// paper: redoes the paper that Poise comes from. Figures, table of minima and findings, into a
// directory: docs/paper.md.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "apps/paper/figures.hpp"
#include "apps/paper/findings.hpp"
#include "apps/paper/minima.hpp"
#include "flags.hpp"
#include "pictures/plot.hpp"

namespace poise::study {
namespace {

namespace fs = std::filesystem;

/// A directory that is filled with what has been drawn and written.
class Output {
 public:
  explicit Output(const std::string& directory) : directory_(directory) {
    std::error_code error;
    fs::create_directories(directory, error);
    if (error) throw OutputError(directory + ": cannot be made a directory: " + error.message());
  }
  void figure(const std::string& name, const std::string& script) {
    draw(script, path(name + ".svg"));
  }
  void text(const std::string& name, const std::string& text) { write_file(text, path(name)); }
  const std::string& names() const { return names_; }

 private:
  std::string path(const std::string& name) {
    names_ += (names_.empty() ? "" : ", ") + name;
    return (directory_ / name).string();
  }

  fs::path directory_;
  std::string names_{};
};

void draw_figures(Output& output, const PaperDisks& disks) {
  output.figure("figure-2", range_figure("Fig. 2: the range of pinching up", disks.fig4a.disk));
  output.figure("figure-3a", curves_figure({disks.fig3a}));
  output.figure("figure-3b", curves_figure({disks.fig3b}));
  output.figure("figure-3c", curves_figure({disks.fig3c}));
  output.figure("figure-4a", curves_figure({disks.fig4a}));
  output.figure("figure-4b", curves_figure({disks.fig4b}));
  output.figure("figure-4c", curves_figure({disks.fig4c, disks.fig4c_more}));
  output.figure("figure-5", evaluation_figure(disks.fig5));
  output.figure("figure-6", evaluation_figure(disks.fig6));
  output.figure("figure-7", postures_figure("Fig. 7: the postures a, b and c", disks.fig6.disk));
  output.figure("equal-frictions",
                efforts_figure("V for equal frictions", {disks.fig3a, disks.fig3b, disks.fig3c,
                                                         disks.fig4a, disks.fig4c_more}));
  std::vector<NamedDisk> mapped{disks.fig4c_more, disks.fig3a, disks.fig3b,
                                disks.fig3c,      disks.fig4a, disks.fig6};
  std::vector<NamedDisk> sampled{disks.fig3c, disks.fig6};
  if (disks.given) {
    const NamedDisk& given = *disks.given;
    output.figure("given-range", range_figure("The range of pinching up", given.disk));
    output.figure("given-curves", curves_figure({given}));
    output.figure("given-postures", postures_figure(given.name, given.disk));
    mapped.push_back(given);
    if (has_b(given)) sampled.push_back(given);
  }
  output.figure("when-b-is-a-minimum", minimum_figure(mapped));
  output.figure("sampling", sampling_figure(sampled));
}

/// What the command line asks for.
struct Asked {
  std::string out{};
  GivenDisk disk{};
  bool json{false};
};

void declare(Flags& flags, Asked& asked) {
  flags
      .value("--out", "DIR", "The directory to write to",
             [&](const std::string& text) {
               if (text.empty()) throw UsageError("--out: '' is not a directory");
               asked.out = text;
             })
      .required();
  const auto angle = [](double deg) { return deg > 0 && deg <= 90; };
  const auto friction = [](double mu) { return mu >= 0 && mu <= 1e6; };
  const auto force = [](double newtons) { return newtons > 0 && newtons <= 1e6; };
  flags.value("--phi", "DEG", "Also for a disk with contacts at PHI to either side of +y (75)",
              [&, angle](const std::string& text) {
                asked.disk.phi_deg =
                    read_number("--phi", text, "an angle above 0 and at most 90 degrees", angle);
              });
  flags.value("--mu1", "MU", "and this friction on the right (1)",
              [&, friction](const std::string& text) {
                asked.disk.mu1 = read_number("--mu1", text, "a friction, 0 to 1e6", friction);
              });
  flags.value("--mu2", "MU", "and on the left (0.57735)", [&, friction](const std::string& text) {
    asked.disk.mu2 = read_number("--mu2", text, "a friction, 0 to 1e6", friction);
  });
  flags.value("--weight", "N", "The weight of all disks, in newtons (10)",
              [&, force](const std::string& text) {
                asked.disk.weight =
                    read_number("--weight", text, "a weight above 0 and at most 1e6", force);
              });
  flags.json(asked.json);
}

std::string answer(const Asked& asked) {
  const PaperDisks disks(asked.disk);
  const std::vector<NamedDisk> all = disks.all();
  Output output(asked.out);
  output.text("minima.txt", minima_table(all, {}));
  draw_figures(output, disks);
  output.text("findings.md", findings(disks));
  if (asked.json) return minima_document(asked.out, asked.disk, all);
  const Style style = style_of_output();
  return style.bold("Minima in the range of pinching up") + "\n" + minima_table(all, style) + "\n" +
         wrapped("Wrote " + output.names() + " to " + asked.out + ".");
}

/// @return what to print
std::string run(int argc, char** argv) {
  CLI::App app{"The figures and findings of the paper that Poise comes from."};
  app.name("paper");
  app.get_formatter()->label("REQUIRED", "");
  Flags flags(app);
  Asked asked;
  declare(flags, asked);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return app.help();
  } catch (const CLI::ParseError& error) {
    throw UsageError(std::string(error.what()) + ", see paper --help");
  }
  flags.read();
  return answer(asked);
}

}  // namespace
}  // namespace poise::study

int main(int argc, char** argv) {
  try {
    const std::string text = poise::study::run(argc, argv);
    if (std::fputs(text.c_str(), stdout) >= 0 && std::fflush(stdout) == 0) return 0;
    std::perror("paper: cannot write the answer");
  } catch (const std::exception& error) {
    std::fputs((std::string("paper: ") + error.what() + "\n").c_str(), stderr);
  }
  return 2;
}
