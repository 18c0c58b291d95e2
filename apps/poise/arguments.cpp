#include "arguments.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <utility>

#include "files/text.hpp"

namespace poise {
namespace {

std::string quoted(const std::string& text) { return "'" + shown(text) + "'"; }

/// A finite number, and nothing after it.
std::optional<double> parsed(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end || !std::isfinite(value)) return {};
  return value;
}

double read_angle(const std::string& text) {
  const auto degrees = parsed(text);
  if (!degrees) throw UsageError("--angle: " + quoted(text) + " is not a number of degrees");
  const double angle = std::remainder(*degrees, 360.0);
  return angle <= -180 ? 180 : angle;
}

/// Numbers between commas; empty if they are none.
std::vector<double> parsed_list(std::string_view text) {
  std::vector<double> numbers;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const auto number = parsed(text.substr(at, comma - at));
    if (!number) return {};
    numbers.push_back(*number);
    at = comma + 1;
  }
  return numbers;
}

/// Numbers that are not all 0, as many as in one of the examples.
std::vector<double> read_direction(const std::string& flag, const std::string& text,
                                   std::size_t least, std::size_t most,
                                   const std::string& examples) {
  std::vector<double> numbers = parsed_list(text);
  if (numbers.size() < least || numbers.size() > most)
    throw UsageError(flag + ": " + quoted(text) + " is not a direction, must be like " + examples);
  if (std::all_of(numbers.begin(), numbers.end(), [](double number) { return number == 0; }))
    throw UsageError(flag + ": " + text + " has no direction");
  return numbers;
}

Vector<3> read_tilt_from(const std::string& text) {
  const std::vector<double> v = read_direction("--tilt-from", text, 3, 3, "0,0,1");
  return Vector<3>(v[0], v[1], v[2]).stableNormalized();
}

double read_tilt_max(const std::string& text) {
  const auto degrees = parsed(text);
  if (!degrees || !(*degrees >= 0 && *degrees <= 90))
    throw UsageError("--tilt-max: " + quoted(text) + " is not an angle from 0 to 90 degrees");
  return *degrees;
}

Eigen::Quaterniond read_orientation(const std::string& text) {
  const std::vector<double> v = parsed_list(text);
  if (v.size() != 4)
    throw UsageError("--orientation: " + quoted(text) +
                     " is not a quaternion, must be like 1,0,0,0 (w first)");
  const Eigen::Vector4d wxyz = Eigen::Vector4d(v[0], v[1], v[2], v[3]).stableNormalized();
  if (!(wxyz.norm() > 0.5)) throw UsageError("--orientation: " + text + " has no length");
  return {wxyz[0], wxyz[1], wxyz[2], wxyz[3]};
}

double read_gap(const std::string& text) {
  const auto gap = parsed(text);
  if (!gap || !(*gap > 0 && *gap < 1))
    throw UsageError("--gap: " + quoted(text) + " is not a part of the effort, must be above 0 " +
                     "and below 1");
  return *gap;
}

int read_max_holds(const std::string& text) {
  const auto holds = parsed(text);
  if (!holds || !(*holds >= 1 && *holds <= 1e6) || *holds != std::floor(*holds))
    throw UsageError("--max-holds: " + quoted(text) +
                     " is not a number of holds, must be from 1 to 1000000");
  return static_cast<int>(*holds);
}

std::size_t read_grasp(const std::string& text) {
  const auto number = parsed(text);
  if (!number || !(*number >= 0 && *number <= 1e9) || *number != std::floor(*number))
    throw UsageError("--grasp: " + quoted(text) + " is not the number of a grasp, the first is 0");
  return static_cast<std::size_t>(*number);
}

double read_force_cap(const std::string& text) {
  const auto cap = parsed(text);
  if (!cap || !(*cap > 0 && *cap <= 1e9))
    throw UsageError("--force-cap: " + quoted(text) +
                     " is not a number of weights, must be above 0 and at most 1e9");
  return *cap;
}

double read_safety(const std::string& text) {
  const auto safety = parsed(text);
  if (!safety || !(*safety >= 1 && *safety <= 1e6))
    throw UsageError("--safety: " + quoted(text) +
                     " is not a factor, must be at least 1 and at most 1e6");
  return *safety;
}

/// A number of `paper`, at least (or, where `above`, above) 0 and at most `most`.
double read_number(const char* flag, const std::string& text, bool above, double most) {
  const auto value = parsed(text);
  if (value && (above ? *value > 0 : *value >= 0) && *value <= most) return *value;
  std::ostringstream range;
  range << (above ? "above 0" : "at least 0") << " and at most " << most;
  throw UsageError(std::string(flag) + ": " + quoted(text) + " must be a number " + range.str());
}

Domain read_domain(const std::string& text) {
  if (text == "all") return Domain::all;
  if (text == "pinched") return Domain::pinched;
  throw UsageError("--domain: " + quoted(text) + " must be all or pinched");
}

/// Where `view` writes to unless told: in the present folder.
std::string page_of(const std::string& file) {
  return (file == "-" ? "grasp" : std::filesystem::path(file).stem().string()) + ".html";
}

std::string full_name(const CLI::App& command) {
  return (command.get_parent() ? "poise " : "") + command.get_name();
}

std::string options_of(const CLI::App& command) {
  std::string list;
  for (const CLI::Option* const option : command.get_options())
    if (!option->get_lnames().empty())
      list += (list.empty() ? "--" : ", --") + option->get_lnames().front();
  return list;
}

/// The command line as CLI11 sees it, and where it puts what it finds.
struct Parser {
  CLI::App app{
      "How to turn a held object so that its fingers press least, and how hard they press."};
  Arguments arguments{};
  std::optional<std::string> angle{}, up{}, domain{}, force_cap{}, safety{}, phi{}, mu1{}, mu2{},
      weight{};
  std::optional<std::string> gap{}, max_holds{}, tilt_from{}, tilt_max{}, orientation{};
  std::optional<std::string> page{}, out{}, grasp{};
  std::string kind{};

  Parser() {
    app.name("poise");
    app.set_version_flag("--version", "poise " POISE_VERSION, "Print the version");
    app.set_help_flag("-h,--help", "Print this help");
    app.require_subcommand(1);
    app.get_formatter()->label("SUBCOMMAND", "COMMAND");
    app.get_formatter()->label("Positionals", "Arguments");
    app.get_formatter()->label("REQUIRED", "");
    app.get_formatter()->label("Excludes", "not with");
    app.footer(
        "FILE is a grasp file (YAML or JSON), or - for standard input.\n"
        "Exit status: 0 it can be held, 1 it cannot be held, 2 bad input or usage;\n"
        "of verify: 0 confirmed, 1 refuted, 2 bad input or usage.");

    add("check", "Say how a grasp file is understood, with warnings");
    CLI::App* const hold = add("hold", "The least contact forces in one posture");
    CLI::App* const best = add("best", "The posture in which the fingers press least");
    CLI::App* const curve = add("curve", "The least effort over all postures, with its optima");

    CLI::App* const capacity =
        add("capacity", "The greatest weight, the least friction, the force to command");

    CLI::App* const draw =
        app.add_subcommand("draw", "A picture of the object as it hangs")->group("Commands");
    draw->add_option("FILE", arguments.file, "The grasp file")->type_name("")->required();
    draw->add_option("-o,--out", out, "The picture to write")->type_name("SVG|PNG")->required();

    for (CLI::App* const command : {hold, capacity, draw}) {
      auto* const angle_option =
          command->add_option("--angle", angle, "Posture: the object turned counter-clockwise")
              ->type_name("DEG");
      command->add_option("--up", up, "Posture: the direction against gravity")
          ->type_name("X,Y[,Z]")
          ->excludes(angle_option);
    }
    capacity
        ->add_option("--safety", safety,
                     "Divide the friction by this, on top of the file's safety, to find the force "
                     "to command (1.5)")
        ->type_name("S");
    for (CLI::App* const command : {best, curve})
      command->add_option("--domain", domain, "Postures to choose from: all, or those not cradled")
          ->type_name("all|pinched");
    for (CLI::App* const command : {hold, best, curve, capacity, draw})
      command
          ->add_option("--force-cap", force_cap, "Greatest force norm of a hold, in weights (1e6)")
          ->type_name("N");
    best->add_option("--gap", gap, "Space: how far the effort may be above the proven bound (1e-6)")
        ->type_name("PART");
    best->add_option("--max-holds", max_holds, "Space: holds to spend on the proof (2000)")
        ->type_name("N");
    best->add_option("--tilt-from", tilt_from, "Space: choose from postures near this one")
        ->type_name("X,Y,Z");
    best->add_option("--tilt-max", tilt_max, "Space: at most so far from it, 0 to 90")
        ->type_name("DEG");
    best->add_option("--orientation", orientation,
                     "Space: how the object is turned now, object to world, +z up")
        ->type_name("W,X,Y,Z");
    curve->add_option("--plot", arguments.plot, "Draw the held object beside the curve")
        ->type_name("SVG");
    add("verify", "Check a result of these commands again, by other means")
        ->add_option("RESULT", arguments.result,
                     "What check, hold, best, curve or capacity printed by --json")
        ->type_name("")
        ->required();
    add_contacts();
    add_view();
    add_import();
    add_paper();
  }

  void add_import() {
    CLI::App* const import =
        app.add_subcommand("import", "A grasp of a data set as a grasp file")->group("Commands");
    import->add_option("KIND", kind, "acronym, the only data set that is known")
        ->type_name("")
        ->required();
    import->add_option("FILE", arguments.file, "The file of the data set (.h5)")
        ->type_name("")
        ->required();
    import->add_option("--mesh-root", arguments.mesh_root, "The folder that has the meshes/")
        ->type_name("DIR")
        ->required();
    import->add_option("--grasp", grasp, "Which grasp of the file, from 0")
        ->type_name("N")
        ->required();
    import->add_option("-o,--out", out, "The grasp file to write, instead of printing it")
        ->type_name("FILE");
  }

  void add_contacts() {
    CLI::App* const contacts =
        app.add_subcommand("contacts", "Where a gripper touches: the grasp file with contacts")
            ->group("Commands");
    contacts->add_option("FILE", arguments.file, "The grasp file")->type_name("")->required();
    contacts->add_option("-o,--out", out, "The grasp file to write, instead of printing it")
        ->type_name("FILE");
  }

  void add_view() {
    CLI::App* const view =
        app.add_subcommand("view", "Write a page on which to turn and change the grasp")
            ->group("Commands");
    view->add_option("FILE", arguments.file, "The grasp file")->type_name("")->required();
    view->add_option("-o,--out", page, "The page to write (the name of FILE, with .html)")
        ->type_name("HTML");
  }

  void add_paper() {
    CLI::App* const paper =
        app.add_subcommand("paper", "The figures and findings of the paper that Poise comes from")
            ->group("Commands");
    paper->add_option("--out", arguments.paper.out, "The directory to write to")
        ->type_name("DIR")
        ->required();
    paper
        ->add_option("--phi", phi, "Also for a disk with contacts at PHI to either side of +y (75)")
        ->type_name("DEG");
    paper->add_option("--mu1", mu1, "and this friction on the right (1)")->type_name("MU");
    paper->add_option("--mu2", mu2, "and on the left (0.57735)")->type_name("MU");
    paper->add_option("--weight", weight, "The weight of all disks, in newtons (10)")
        ->type_name("N");
    add_json(paper);
  }

  void add_json(CLI::App* command) {
    command->add_flag("--json", arguments.json, "Print one JSON document instead of tables")
        ->disable_flag_override();
  }

  CLI::App* add(const std::string& name, const std::string& description) {
    CLI::App* const command = app.add_subcommand(name, description)->group("Commands");
    command->add_option("FILE", arguments.file, "The grasp file")->type_name("")->required();
    add_json(command);
    return command;
  }

  void read_values() {
    const std::string& name = app.get_subcommands().front()->get_name();
    arguments.command = name == "check"      ? Command::check
                        : name == "contacts" ? Command::contacts
                        : name == "hold"     ? Command::hold
                        : name == "best"     ? Command::best
                        : name == "curve"    ? Command::curve
                        : name == "capacity" ? Command::capacity
                        : name == "draw"     ? Command::draw
                        : name == "verify"   ? Command::verify
                        : name == "view"     ? Command::view
                        : name == "import"   ? Command::import
                                             : Command::paper;
    if (angle) arguments.angle_deg = read_angle(*angle);
    if (up) arguments.up = read_direction("--up", *up, 2, 3, "0.5,0.8 (in space 0.5,0,0.8)");
    if (gap) arguments.gap = read_gap(*gap);
    if (max_holds) arguments.max_holds = read_max_holds(*max_holds);
    if (tilt_from) arguments.tilt_from = read_tilt_from(*tilt_from);
    if (tilt_max) arguments.tilt_max_deg = read_tilt_max(*tilt_max);
    if (orientation) arguments.orientation = read_orientation(*orientation);
    if (domain) arguments.domain = read_domain(*domain);
    if (arguments.plot && arguments.plot->empty()) throw UsageError("--plot: '' is not a file");
    if (out && out->empty()) throw UsageError("--out: '' is not a file");
    arguments.out = out.value_or("");
    if (arguments.command == Command::draw && !arguments.out.ends_with(".svg") &&
        !arguments.out.ends_with(".png"))
      throw UsageError("--out: '" + shown(arguments.out) + "' must end with .svg or .png");
    if (arguments.command == Command::import && kind != "acronym")
      throw UsageError("import: " + quoted(std::as_const(kind)) +
                       " is no known data set, must be acronym");
    if (grasp) arguments.grasp = read_grasp(*grasp);
    if (page && page->empty()) throw UsageError("--out: '' is not a file");
    arguments.page = page ? *page : page_of(arguments.file);
    PaperArguments& paper = arguments.paper;
    if (arguments.command == Command::paper && paper.out.empty())
      throw UsageError("--out: '' is not a directory");
    if (phi) paper.phi_deg = read_number("--phi", *phi, true, 90);
    if (mu1) paper.mu1 = read_number("--mu1", *mu1, false, 1e6);
    if (mu2) paper.mu2 = read_number("--mu2", *mu2, false, 1e6);
    if (weight) paper.weight = read_number("--weight", *weight, true, 1e6);
    if (force_cap) arguments.force_cap = read_force_cap(*force_cap);
    if (safety) arguments.safety = read_safety(*safety);
  }

  /// What to say about words that nothing was waiting for.
  void refuse_rest() const {
    const auto commands = app.get_subcommands();
    const bool before = commands.empty() || !app.remaining().empty();
    const CLI::App& command = before ? app : *commands.front();
    const std::vector<std::string> rest = command.remaining();
    if (rest.empty()) return;
    const auto option = std::find_if(rest.begin(), rest.end(),
                                     [](const auto& word) { return word.starts_with('-'); });
    const std::string& word = option != rest.end() ? *option : rest.front();
    if (word.starts_with('-'))
      throw UsageError("unknown option " + shown(word) + ", " + full_name(command) + " knows " +
                       options_of(command));
    if (before)
      throw UsageError("unknown command " + quoted(word) +
                       ", must be check, contacts, hold, best, curve, capacity, draw, verify, " +
                       "view, import or paper");
    throw UsageError("unexpected " + quoted(word) + ", " + full_name(command) + " takes " +
                     (command.get_name() == "paper"    ? "no FILE"
                      : command.get_name() == "verify" ? "one FILE and one RESULT"
                                                       : "one FILE"));
  }
};

}  // namespace

std::variant<Arguments, std::string> read_arguments(int argc, const char* const* argv) {
  Parser parser;
  try {
    parser.app.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // help or version
    std::ostringstream text;
    parser.app.exit(asked, text, text);
    return text.str();
  } catch (const CLI::ParseError& error) {
    parser.refuse_rest();
    throw UsageError(std::string(error.what()) + ", see poise --help");
  }
  parser.read_values();
  return parser.arguments;
}

}  // namespace poise
