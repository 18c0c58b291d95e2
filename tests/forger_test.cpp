// An adversary: results of every command, true ones and then with something changed in them.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <nlohmann/json.hpp>

#include "ask/ask.hpp"
#include "ask/document.hpp"
#include "files/field.hpp"
#include "poise/grip.hpp"
#include "random_space_grasps.hpp"
#include "verify/statics.hpp"
#include "verify/verify.hpp"

namespace poise::test {
namespace {

using Json = nlohmann::ordered_json;
using Pointer = Json::json_pointer;

template <class T>
const T& any_of(const std::vector<T>& list) {
  return list[static_cast<std::size_t>(pick(0, static_cast<int>(list.size()) - 1))];
}

// Grasps and questions.

template <int Dim>
Wrench<Dim> random_wrench() {
  Wrench<Dim> w;
  for (double& number : w) number = 2 * coordinate();
  return w;
}

PlanarFile random_planar_file() {
  const Held held =
      one_in(8) ? *nearly_unholdable() : *grasps({.most_contacts = 5, .awkward = one_in(4)});
  PlanarFile file;
  file.contacts = held.contacts;
  file.loads = {held.object};
  if (one_in(2)) file.angle = random_angle();
  if (one_in(3)) file.domain = Domain::pinching_up;
  if (one_in(3)) file.loads = random_loads(3);
  return file;
}

/// Now and then with a second load, or a tilt.
SpatialFile random_spatial_file() {
  const auto held = one_in(6) ? *space::nearly_unholdable()
                              : *space::grasps({.least_contacts = 2,
                                                .most_contacts = 6,
                                                .limits = one_in(2),
                                                .awkward = one_in(4)});
  SpatialFile file;
  file.contacts = held.contacts;
  file.loads = {held.object};
  if (one_in(3)) {
    Load<3> other = held.object;
    other.weight *= real(0.3, 1);
    other.com += 0.2 * space::random_direction();
    file.loads.push_back(other);
  }
  // Now and then something acts besides the weight.
  for (Load<3>& load : file.loads) {
    if (one_in(6)) load.lift = real(-3, 5);
    if (one_in(6)) load.acceleration = real(0, 5) * space::random_direction();
    if (one_in(6)) load.fixed.head<3>() = 0.3 * load.weight * space::random_direction();
    if (one_in(8)) load.fixed.tail<3>() = 0.1 * load.weight * space::random_direction();
  }
  if (one_in(2)) file.up = space::random_direction();
  if (one_in(3)) file.tilt = Tilt{space::random_direction(), real(0, pi / 2)};
  return file;
}

/// What a program can be asked of a grasp.
template <int Dim>
Question random_question() {
  std::vector<Command> commands = {Command::hold, Command::best, Command::turn, Command::capacity,
                                   Command::check, Command::sturdiest};
  if (Dim == 2) commands.push_back(Command::curve);
  Question question;
  question.command = any_of(commands);
  // Not where only the cap ends the arcs of the plane: y do not always prove that.
  const bool is_turn = question.command == Command::turn;
  const bool has_arcs =
      question.command == Command::best || is_turn || question.command == Command::curve;
  if ((Dim == 3 || !has_arcs) && one_in(4))
    question.force_cap = any_of(std::vector<double>{1, 3, 100, 1e7});
  if (one_in(4)) question.safety = real(1, 3);
  question.objective = any_of(std::vector{Objective::grip, Objective::effort});
  if constexpr (Dim == 2) {
    if (one_in(3)) question.domain = any_of(std::vector{Domain::all, Domain::pinching_up});
    if (is_turn || one_in(2)) question.angle_deg = 180 / pi * random_angle();
  } else {
    if (question.command == Command::best || is_turn) {
      question.max_holds = is_turn ? 500 : 200;
      if (one_in(4)) question.gap = any_of(std::vector{1e-3, 1e-8});
      if (one_in(4)) question.orientation = Eigen::Quaterniond(space::random_rotation());
    }
    if (is_turn || one_in(2)) {
      const Vector<3> up = space::random_direction();
      question.up = {up.x(), up.y(), up.z()};
    }
  }
  return question;
}

template <int Dim>
FileOf<Dim> random_file(const Question& question) {
  FileOf<Dim> file;
  if constexpr (Dim == 2)
    file = random_planar_file();
  else
    file = random_spatial_file();
  if (question.command != Command::capacity && one_in(6))
    for (auto& load : file.loads)
      if (load.weight > 0) load.fixed = load.weight * random_wrench<Dim>();
  if (one_in(3)) file.mechanism.kind = DriveKind::coupled;
  return file;
}

verify::Verdict verdict_on(const GraspFile& file, const std::string& text) {
  return verify::verify(file, parse_json(text, "result.json", max_result));
}

// Forgeries.

/// A place in a document.
struct Node {
  Pointer at;
  std::string path;  ///< as verify writes it, without indices: "minima[*].contacts[*]"
};

void collect(const Json& value, const Node& here, std::vector<Node>& nodes) {
  if (value.is_object())
    for (const auto& [key, part] : value.items()) {
      const Node node{here.at / key, here.path.empty() ? key : here.path + "." + key};
      nodes.push_back(node);
      collect(part, node, nodes);
    }
  if (value.is_array())
    for (std::size_t i = 0; i < value.size(); ++i) {
      const Node node{here.at / i, here.path + "[*]"};
      nodes.push_back(node);
      collect(value[i], node, nodes);
    }
}

std::vector<Node> nodes_of(const Json& document) {
  std::vector<Node> nodes;
  collect(document, {Pointer(), ""}, nodes);
  return nodes;
}

void erase(Json& document, const Pointer& at) {
  Json& parent = document[at.parent_pointer()];
  if (parent.is_array())
    parent.erase(std::stoul(at.back()));
  else
    parent.erase(at.back());
}

Json other_word(const std::string& word) {
  const std::vector<std::string> words = {
      "unloaded", "sticking",   "slipping",    "none",     "min",  "max",    "resting",
      "cradled",  "pinched",    "pinching-up", "boundary", "kink", "smooth", "optimal",
      "gap",      "unholdable", "all",         "given",    "now",  "best",   "upright"};
  const std::string& other = any_of(words);
  return other == word ? word + "s" : other;
}

/// Changes one thing; tells what.
std::string forge(Json& document) {
  const std::vector<Node> nodes = nodes_of(document);
  const Node& node = any_of(nodes);
  const Node& other = any_of(nodes);
  Json& value = document[node.at];
  const std::string where = node.at.to_string();
  switch (pick(0, 6)) {
    case 1:
      erase(document, node.at);
      return "drops " + where;
    case 2:
      value = nullptr;
      return "nulls " + where;
    case 3:
      if (value.is_array() && !value.empty()) {
        const Json copy = any_of(std::vector<Json>(value.begin(), value.end()));
        value.insert(value.begin() + pick(0, static_cast<int>(value.size())), copy);
        return "doubles a part of " + where;
      }
      break;
    case 4: {  // another that has the same name, or stands in the same list
      std::vector<Node> twins;
      for (const Node& each : nodes) {
        const bool is_twin = each.path.substr(each.path.rfind('.') + 1) ==
                             node.path.substr(node.path.rfind('.') + 1);
        const bool is_inside =
            each.at.to_string().starts_with(where) || where.starts_with(each.at.to_string());
        if (is_twin && !is_inside) twins.push_back(each);
      }
      if (twins.empty()) break;
      const Node& twin = any_of(twins);
      if (one_in(2)) {
        std::swap(value, document[twin.at]);
        return "swaps " + where + " and " + twin.at.to_string();
      }
      value = Json(document[twin.at]);
      return "copies " + twin.at.to_string() + " to " + where;
    }
    case 5:
      value = Json(document[other.at]);
      return "copies " + other.at.to_string() + " to " + where;
    default:
      break;
  }
  if (value.is_number()) {
    const double factor =
        any_of(std::vector{1 + 2e-5, 1 - 2e-5, 1.001, 2.0, 0.5, 0.0, -1.0, 1e3, 1e9, 1 / 3.0});
    value = value.get<double>() * factor;
    return "multiplies " + where + " by " + std::to_string(factor);
  }
  if (value.is_boolean()) value = !value.get<bool>();
  if (value.is_string()) value = other_word(value.get<std::string>());
  return "changes " + where;
}

// What counts as a change.

bool is_below(const std::string& path, const std::string& part) {
  return path == part || path.starts_with(part + ".") || path.starts_with(part + "[");
}

/// Whether numbers differ by more than any tolerance; `size` is that of what they stand among.
bool differ(double a, double b, const std::string& key, double size) {
  const double off = std::abs(a - b);
  if (key.ends_with("_deg")) return off > 1e-4 && std::abs(off - 360) > 1e-4;
  if (key == "relative_gap" || key == "residual" || key == "friction_used") return off > 1e-5;
  return off > 1e-5 * std::max({std::abs(a), std::abs(b), size, 1e-6});
}

/// The size of the numbers in a value, and in lists in it.
double size_of(const Json& value) {
  double size = 0;
  for (const Json& part : value)
    if (part.is_number())
      size = std::max(size, std::abs(part.get<double>()));
    else if (part.is_array() && !part.empty() && part.front().is_number())
      size = std::max(size, size_of(part));
  return size;
}

/// Forces are as exact as the largest of them; the numbers of a list, and of V, go together.
double size_among(const Json& parent, const std::string& path) {
  if (parent.is_array() || path.ends_with(".V") || path.ends_with("contacts[*]") ||
      path.ends_with("fingers[*]"))
    return size_of(parent);
  return 0;
}

/// Bounds on weights are as exact as the given one.
double size_for(const std::string& key, const Json& parent, const std::string& path) {
  const bool is_bound = key == "least_bound" || key == "greatest_bound";
  return is_bound && parent.contains("given") ? parent["given"].get<double>()
                                              : size_among(parent, path);
}

/// Whether a key has proofs, of which any will do that prove.
bool is_proof(const std::string& key) {
  const auto keys = {"dual", "greatest_dual",   "least_dual",     "y",           "rates",
                     "cuts", "unholdable_arcs", "greatest_rates", "least_rates", "wall",
                     "held"};
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

Json sorted(Json list) {
  std::sort(list.begin(), list.end());
  return list;
}

/// The places in which claims differ; the order of arcs is none.
void compare(const Json& a, const Json& b, const std::string& path, const std::string& key,
             double size, std::vector<std::string>& differing) {
  const auto within = [&](const std::string& name) {
    return path.empty() ? name : path + "." + name;
  };
  if (is_proof(key)) return;
  if (a.is_number() && b.is_number()) {
    // What is withstood is known from both sides to a part of 1e-3.
    const bool both_sides = path.find("shake") != std::string::npos || path == "acceleration" ||
                            path.find(".tilt") != std::string::npos;
    const double x = a.get<double>(), y = b.get<double>();
    const bool near = both_sides && std::abs(x - y) <= 2.1e-3 * std::max({x, y, 10.0});
    if (!near && differ(x, y, key, size)) differing.push_back(path);
  } else if (a.is_object() && b.is_object()) {
    for (const auto& [name, part] : a.items())
      if (b.contains(name))
        compare(part, b[name], within(name), name, size_for(name, a, path), differing);
      else
        differing.push_back(within(name));
    for (const auto& [name, part] : b.items())
      if (!a.contains(name)) differing.push_back(within(name));
  } else if (a.is_array() && b.is_array() && a.size() == b.size()) {
    const auto is = [&](const std::string& list) {
      return path == list || path.ends_with("." + list);
    };
    const bool ordered = !is("arcs") && !is("holdable_arcs_deg");
    const Json own = ordered ? a : sorted(a), other = ordered ? b : sorted(b);
    for (std::size_t i = 0; i < a.size(); ++i)
      compare(own[i], other[i], path + "[*]", key, size_among(a, path), differing);
  } else if (a != b && !(a == "unholdable" && b == "gap")) {  // which claims less
    differing.push_back(path);
  }
}

/// Whether a forgery claims less there: a weaker bound, or nothing of a turn.
bool claims_less(const Json& document, const Json& forged, const std::string& path) {
  std::string pointer = "/" + path;
  std::replace(pointer.begin(), pointer.end(), '.', '/');
  const Pointer at(pointer);
  if (path.find('*') != std::string::npos || !document.contains(at) || !forged.contains(at))
    return false;
  const Json &was = document[at], &is = forged[at];
  const auto ends = [&](const char* key) {
    return path == key || path.ends_with(std::string(".") + key);
  };
  if (is.is_null())
    return path == "turn" || ends("way") || ends("other_way") || ends("without_pressing_harder");
  if (!was.is_number() || !is.is_number()) return false;
  const bool is_of_turn = path.starts_with("turn.") || path.starts_with("without_pressing_harder.");
  if (is_of_turn && ends("peak")) return is > was;
  if (is_of_turn && (ends("lower_bound") || ends("reachable_bound"))) return is < was;
  return path == "lower_bound" && document["command"] == "best" && is < was;
}

/// The places in which a forgery claims something else, and does not itself say that it has not
/// been checked.
std::vector<std::string> changes(const Json& document, Json forged,
                                 const verify::Verdict& verdict) {
  std::vector<std::string> differing, changed;
  // In space one of the minima instead of another is a hold all the same.
  if (document.contains("minima_complete") && forged["minima"].is_array()) {
    const Json& minima = document["minima"];
    const auto is_one = [&](const Json& hold) {
      return std::find(minima.begin(), minima.end(), hold) != minima.end();
    };
    if (std::all_of(forged["minima"].begin(), forged["minima"].end(), is_one))
      forged["minima"] = minima;
  }
  compare(document, forged, "", "", 0, differing);
  for (const std::string& path : differing) {
    const auto& unchecked = verdict.unchecked();
    const auto names = [&](const verify::Unchecked& each) {
      // Holds and arcs in a list of which it is open whether it is complete are checked.
      const auto lists = {"minima", "holdable_arcs_deg", "best_pinched", "capacities"};
      const bool is_list = std::find(lists.begin(), lists.end(), each.where) != lists.end();
      return path == each.where || (!is_list && is_below(path, each.where));
    };
    // Optima lie where friction begins to be needed: there both manners are right.
    const bool at_fork = path.ends_with("manner") && document["options"].contains("domain");
    // Of two loads that cannot be held either decides.
    const bool is_either = path == "load" && document["holdable"] == false;
    if (!at_fork && !claims_less(document, forged, path) && !is_either &&
        std::none_of(unchecked.begin(), unchecked.end(), names))
      changed.push_back(path);
  }
  return changed;
}

/// Whether a forgery is another question: what is claimed may well be an answer to it.
bool asks_otherwise(const Json& document, const Json& forged) {
  return document["options"] != forged["options"];
}

/// Whether a result itself says that its answer is not known for sure: anywhere.
bool leaves_open(const Json& result) {
  if (result.is_object() && result.value("proven", true) == false) return true;
  return std::any_of(result.begin(), result.end(),
                     [](const Json& part) { return part.is_structured() && leaves_open(part); });
}

struct Tally {
  long results{0}, open{0}, forgeries{0}, harmless{0}, refused{0}, refuted{0};
  ~Tally() {
    std::printf(
        "%ld results, %ld leave something open; %ld forgeries: %ld refused, %ld refuted, "
        "%ld claim nothing else\n",
        results, open, forgeries, refused, refuted, harmless);
  }
};

/// A true result is confirmed, and nothing forged from it that claims something else.
template <int Dim>
void expect_no_forgery_confirmed(Tally& tally) {
  const Question question = random_question<Dim>();
  const FileOf<Dim> file = random_file<Dim>(question);
  const Grasp<Dim> grasp = file.grasp();
  if (question.objective == Objective::grip && !has_grip<Dim>(grasp)) return;
  const std::string text = document<Dim>(file, grasp, ask(file, grasp, question));
  RC_LOG() << "the grasp: " << document<Dim>(file, grasp, CheckAnswer<Dim>{}) << "\n";
  const Json result = Json::parse(text);
  ++tally.results;
  if (leaves_open(result)) ++tally.open;
  const verify::Verdict verdict = verdict_on(file, text);
  if (!verdict.confirmed()) RC_FAIL("refuted: " + refutations_text(verdict) + text);
  for (int k = 0; k < 5; ++k) {
    Json forged = result;
    const std::string what = forge(forged);
    ++tally.forgeries;
    try {
      const verify::Verdict verdict = verdict_on(file, forged.dump());
      if (!verdict.confirmed()) {
        ++tally.refuted;
      } else if (asks_otherwise(result, forged) || changes(result, forged, verdict).empty()) {
        ++tally.harmless;
      } else {
        RC_FAIL("confirmed, though somebody " + what + ": " +
                changes(result, forged, verdict).front() + "\n" + text);
      }
    } catch (const FileError&) {
      ++tally.refused;
    }
  }
}

// Forgeries of whole answers: all that follows from what is false follows.

using Matrix = Eigen::MatrixXd;

Eigen::VectorXd random_combination(const Matrix& columns) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(columns.rows());
  for (const auto& column : columns.colwise()) sum += coordinate() * column;
  return sum;
}

void set_force(ContactForce<2>& force, const Contact<2>&, const Eigen::VectorXd& f) {
  force.normal = f[0];
  force.tangential = f[1];
}
void set_force(ContactForce<3>& force, const Contact<3>& contact, const Eigen::VectorXd& f) {
  const Eigen::MatrixXd G =
      verify::real_grasp(Grasp<3>(Load<3>{}, {contact})).contacts[0].G.cast<double>();
  const Wrench<3> w = G * f;
  force.normal = f[0];
  force.tangential = w.head<3>() - f[0] * contact.normal;
  if (f.size() == 4) force.torsion_moment = f[3] * contact.torsion / contact.friction;
}

Eigen::VectorXd force_of(const verify::RealContact&, const ContactForce<2>& force) {
  return Vector<2>(force.normal, force.tangential);
}
Eigen::VectorXd force_of(const verify::RealContact& contact, const ContactForce<3>& force) {
  const Vector<3> vector = force.normal * contact.normal.cast<double>() + force.tangential;
  Eigen::VectorXd f = contact.G.topRows(3).transpose().cast<double>() * vector;
  if (f.size() == 4) f[3] = force.torsion_moment / contact.G.col(3).tail(3).norm();
  return f;
}

/// Contacts that press against each other more, or less, with no change to what they hold; within
/// their cones.
template <int Dim>
std::optional<Hold<Dim>> pressed_otherwise(const Grasp<Dim>& grasp, Hold<Dim> hold) {
  const verify::RealGrasp real_grasp = verify::real_grasp(grasp);
  Matrix G(wrench_size<Dim>, 0);
  for (const verify::RealContact& contact : real_grasp.contacts) {
    G.conservativeResize(Eigen::NoChange, G.cols() + contact.G.cols());
    G.rightCols(contact.G.cols()) = contact.G.cast<double>();
  }
  const Eigen::VectorXd more = grasp.size() * random_combination(G.fullPivLu().kernel());
  hold.effort = 0;
  Eigen::Index first = 0;
  for (std::size_t i = 0; i < hold.forces.size(); ++i) {
    const Contact<Dim>& contact = grasp.contacts()[i];
    ContactForce<Dim>& force = hold.forces[i];
    const Eigen::Index size = real_grasp.contacts[i].G.cols();
    const Eigen::VectorXd f = force_of(real_grasp.contacts[i], force) + more.segment(first, size);
    first += size;
    const double beside = f.tail(size - 1).norm(), edge = contact.friction * f[0];
    if (f[0] < contact.min_normal || f[0] > contact.max_normal || beside > edge) return {};
    set_force(force, contact, f);
    const bool loaded = f[0] > 1e-9 * grasp.size();
    force.friction_used = !loaded ? 0 : edge > 0 ? beside / edge : 1;
    force.state = !loaded                          ? ContactState::unloaded
                  : force.friction_used > 1 - 1e-9 ? ContactState::slipping
                                                   : ContactState::sticking;
    force.limit = f[0] >= contact.max_normal - 1e-9 * grasp.size() ? ForceLimit::max
                  : contact.min_normal > 0 && f[0] <= contact.min_normal + 1e-9 * grasp.size()
                      ? ForceLimit::min
                      : ForceLimit::none;
    hold.effort += f.squaredNorm() / contact.share;
  }
  return hold;
}

/// Lengthens a dual: as it is, or by a motion that no contact feels, if there is one.
template <int Dim>
void lengthen(const Grasp<Dim>& grasp, Twist<Dim>& dual) {
  const double times = any_of(std::vector{0.0, 1e-3, 1.0, 1e6, 1e12, 1e22});
  if (one_in(3)) {
    dual *= times;
    return;
  }
  Matrix G(0, wrench_size<Dim>);
  for (const verify::RealContact& contact : verify::real_grasp(grasp).contacts) {
    G.conservativeResize(G.rows() + contact.G.cols(), Eigen::NoChange);
    G.bottomRows(contact.G.cols()) = contact.G.transpose().cast<double>();
  }
  dual += times * random_combination(G.fullPivLu().kernel());
}

template <int Dim>
Vector<Dim> random_up() {
  if constexpr (Dim == 2)
    return up_at(random_angle());
  else
    return space::random_direction();
}

/// A hold that is not the least, or said not to be one; or nothing.
template <int Dim>
std::optional<HoldAnswer<Dim>> false_hold(const Grasp<Dim>& grasp) {
  const Vector<Dim> up = random_up<Dim>();
  HoldAnswer<Dim> answer{.posture = posture_at(grasp, up)};
  answer.option.up.assign(up.begin(), up.end());
  Hold<Dim>& hold = answer.posture.holds[0];
  if (!hold.holdable) return {};
  if (one_in(3)) {
    hold.holdable = false;
    hold.lower_bound = any_of(std::vector{hold.effort, 2e12 * grasp.size() * grasp.size()});
  } else {
    std::optional<Hold<Dim>> other;
    for (int k = 0; k < 30 && !other; ++k) other = pressed_otherwise(grasp, hold);
    if (!other || !(other->effort > (1 + 1e-5) * hold.effort)) return {};
    hold = *other;
    hold.lower_bound = hold.effort;
  }
  lengthen(grasp, hold.dual);
  return answer;
}

/// A best posture that is not the best, or said to be proven better; or nothing.
template <int Dim>
std::optional<BestAnswer<Dim>> false_best(const Grasp<Dim>& grasp) {
  BestAnswer<Dim> answer;
  if constexpr (Dim == 3) answer.settings.starts = 4;
  answer.best = best_posture(grasp, answer.settings);
  Best<Dim>& best = answer.best;
  if (!best.holdable()) return {};
  const double effort = best.best().effort();
  if (one_in(3)) {
    if (best.minima.size() < 2) return {};
    best.minima.erase(best.minima.begin());
  } else {
    const Posture<Dim> other = posture_at(grasp, random_up<Dim>());
    if (!other.holdable()) return {};
    Minimum<Dim> minimum = best.best();
    static_cast<Posture<Dim>&>(minimum) = other;
    if constexpr (Dim == 2)
      minimum.optimum.angle = minimum.optimum.from = minimum.optimum.to = angle_of(other.up);
    best.minima = {minimum};
  }
  best.pinched.reset();
  for (std::size_t k = 0; k < best.minima.size() && !best.pinched; ++k)
    if (best.minima[k].manner == Manner::pinched) best.pinched = k;
  if (!(best.best().effort() > (1 + 1e-5) * effort)) return {};
  best.status = Status::optimal;
  best.lower_bound = one_in(2) ? best.best().effort() : effort;
  best.relative_gap = 1 - best.lower_bound / best.best().effort();
  return answer;
}

/// The same contacts with the first load alone.
template <int Dim>
Grasp<Dim> with_first(const Grasp<Dim>& grasp) {
  return {grasp.loads().front(), grasp.contacts(), 1, grasp.mechanism()};
}

/// A greatest weight, or a least friction, that is none; or nothing.
template <int Dim>
std::optional<CapacityAnswer<Dim>> false_capacity(const Grasp<Dim>& grasp) {
  const Vector<Dim> up = random_up<Dim>();
  const Load<Dim>& load = grasp.loads().front();
  Capacity<Dim> capacity = poise::capacity(grasp, load, up, 1.5);
  const double part = real(0.1, 0.999);
  if (one_in(2)) {
    WeightEnd<Dim>& greatest = capacity.weights.greatest;
    if (!capacity.weights.holdable || !std::isfinite(greatest.weight)) return {};
    greatest.weight *= part;
    if (one_in(2)) greatest.bound = greatest.weight;
    const Load<Dim> less{.weight = greatest.weight, .com = load.com};
    greatest.posture = posture_at(Grasp<Dim>(less, grasp.contacts()), up);
    if (!greatest.posture.holdable()) return {};
  } else {
    LeastFriction<Dim>& friction = capacity.friction;
    if (!std::isfinite(friction.factor) || !(friction.factor > 0)) return {};
    friction.factor /= part;
    if (one_in(2)) friction.bound = friction.factor;
    std::vector<Contact<Dim>> contacts = grasp.contacts();
    for (Contact<Dim>& contact : contacts) {
      contact.friction *= friction.factor;
      contact.torsion *= friction.factor;
    }
    friction.posture = posture_at(Grasp<Dim>(load, contacts), up);
    if (!friction.posture.holdable()) return {};
  }
  CapacityAnswer<Dim> answer;
  answer.option.up.assign(up.begin(), up.end());
  answer.capacities = {
      {"given", up, 0, capacity, shake(with_first(grasp), up), tilting(with_first(grasp), up)}};
  return answer;
}

template <int Dim>
void expect_no_false_answer_confirmed() {
  const auto held = [] {
    if constexpr (Dim == 2)
      return *grasps({.least_contacts = 2, .most_contacts = 5, .awkward = one_in(4)});
    else
      return *space::grasps({.least_contacts = 2, .most_contacts = 5, .awkward = one_in(4)});
  }();
  const Grasp<Dim> grasp = held.grasp();
  const auto expect_refuted = [&](const auto& answer) {
    if (answer && verify::verify(grasp, *answer).confirmed())
      RC_FAIL("confirmed: " + document(grasp, *answer));
  };
  switch (pick(0, 2)) {
    case 0:
      return expect_refuted(false_hold(grasp));
    case 1:
      return expect_refuted(false_best(grasp));
    default:
      return expect_refuted(false_capacity(grasp));
  }
}

RC_GTEST_PROP(Forger, OfWholeAnswersIsFoundOutInThePlane, ()) {
  expect_no_false_answer_confirmed<2>();
}

RC_GTEST_PROP(Forger, OfWholeAnswersIsFoundOutInSpace, ()) {
  if (one_in(2)) expect_no_false_answer_confirmed<3>();
}

// With RC_PARAMS="max_success=80000" each of these sees 1e5 forgeries, more than anybody waits for.
RC_GTEST_PROP(Forger, IsFoundOutInThePlane, ()) {
  static Tally tally;
  if (!one_in(4)) return;
  expect_no_forgery_confirmed<2>(tally);
}

RC_GTEST_PROP(Forger, IsFoundOutInSpace, ()) {
  static Tally tally;
  if (!one_in(4)) return;
  expect_no_forgery_confirmed<3>(tally);
}

}  // namespace
}  // namespace poise::test
