// Turns in space: peaks against dense samples of the turn, ways against walls checked by plain
// means, a fine grid of the sphere, the plane and closed forms.
#include <gtest/gtest.h>

#include <complex>
#include <map>
#include <numeric>
#include <queue>

#include "poise/grip.hpp"
#include "poise/turn.hpp"
#include "random_space_grasps.hpp"
#include "space_checks.hpp"

namespace poise::test::space {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
using Quaternion = Eigen::Quaterniond;
using Ups = std::vector<Vector<3>>;

/// A grasp, and what is asked of it.
struct Case {
  Grasp<3> grasp;
  TurnSettings settings{};

  double value(const Vector<3>& up) const {
    return posture_at(grasp, Vector<3>(up.normalized()), {settings.force_cap, settings.objective})
        .value();
  }
};

/// Of values: those of least grips, pads and drives with a max have fewer digits.
double digits(const Case& each) {
  return each.settings.objective == Objective::grip || each.grasp.is_general() ? 1e-7 : 1e-9;
}

enum class Kind { plain, limits, max, loads, pads, fixed, count };

Vector<3> anywhere() {
  const Vector<3> v(coordinate(), coordinate(), coordinate());
  return v.norm() > 1e-3 ? Vector<3>(v.normalized()) : Vector<3>(0, 0, 1);
}

/// Fingers round a ball, tilted a little: holdable in most postures.
Case random_case(Kind kind, std::size_t contacts, Objective objective) {
  const double weight = 5;
  Load<3> load{weight, 0.2 * anywhere()};
  std::vector<Contact<3>> fingers;
  Mechanism<3> mechanism;
  const bool soft = one_in(2);
  for (std::size_t i = 0; i < contacts; ++i) {
    const Vector<3> at = anywhere(), off = 0.3 * anywhere();
    Contact<3> finger =
        contact(at.cwiseProduct(Vector<3>(1, 1.5, 0.7)), -(at + off), real(0.3, 1), 0);
    finger.finger = "f" + std::to_string(i);
    if (kind == Kind::pads) {
      finger.pad = rectangular_pad({0.3, 0.2}, finger.normal.unitOrthogonal(), finger.normal, 2);
      finger.pad->reach = {0.1, 0.05};
    } else if (soft) {
      finger.torsion = real(0.05, 0.2);
    }
    if (kind == Kind::limits) {
      if (one_in(2)) finger.max_normal = weight * real(0.6, 3);
      if (one_in(3)) finger.min_normal = weight * real(0, 0.4);
    }
    if (kind == Kind::max)
      mechanism.fingers.push_back({.name = finger.finger, .max_force = weight * 1.5});
    fingers.push_back(finger);
  }
  if (kind == Kind::fixed) load.fixed << 0.5 * anywhere(), 0.3 * anywhere();
  std::vector<Load<3>> loads{load};
  if (kind == Kind::loads) loads.push_back({weight * real(0.3, 1), 0.2 * anywhere()});
  return {Grasp<3>(loads, fingers, 1, mechanism), {.objective = objective}};
}

Case random_case() {
  const auto kind = static_cast<Kind>(pick(0, static_cast<int>(Kind::count) - 1));
  const auto contacts = static_cast<std::size_t>(pick(3, 6));
  const bool by_grip = one_in(2) || kind == Kind::max;
  return random_case(kind, contacts, by_grip ? Objective::grip : Objective::effort);
}

/// The posture after a part of the angle of a rotation that is applied to an orientation.
Vector<3> on_turn(const Quaternion& from, const Turn& turn, double angle) {
  return (Eigen::AngleAxisd(angle, turn.axis) * from).conjugate() * Vector<3>::UnitZ();
}

/// What is wrong with a peak, or nothing.
std::string fault(const Case& each, const Quaternion& from, const Vector<3>& to,
                  const TurnPeak<3>& found, int samples = 400) {
  const Turn turn = turn_to(from, to);
  std::ostringstream words;
  words.precision(12);
  if (std::abs(found.angle - turn.angle) > 1e-7) return "the angle";
  if (!(found.lower_bound <= found.peak)) return "the bound is above the peak";
  if ((found.posture.up - on_turn(from, turn, found.at)).norm() > 2e-6) return "the posture";
  const double there = each.value(found.posture.up);
  if (there != found.posture.value() && !close(there, found.posture.value(), digits(each)))
    return "the posture's value";
  if (found.unholdable.empty() != (found.peak < infinity)) return "unholdable";
  if (found.unholdable.empty()) {
    if (!(there >= found.lower_bound * (1 - digits(each)))) return "no posture needs the bound";
    if (!(found.peak - found.lower_bound <= each.settings.gap * found.peak * (1 + 1e-9)))
      return "the gap";
  }
  for (const auto& stretch : found.unholdable) {
    if (!(stretch.from <= stretch.at && stretch.at <= stretch.to)) return "the stretch's middle";
    if (stretch.posture.holdable()) return "what is said to be unholdable holds";
    if ((stretch.posture.up - on_turn(from, turn, stretch.at)).norm() > 2e-6)
      return "the stretch's posture";
  }
  const auto says_it_holds = [&](double at, double margin) {
    for (const auto& stretch : found.unholdable)
      if (at > stretch.from - margin && at < stretch.to + margin) return false;
    return true;
  };
  const auto check = [&](double at) {
    const double value = each.value(on_turn(from, turn, at));
    if (value > found.peak * (1 + digits(each)))
      words << "needs " << value << " at " << at << ", more than " << found.peak;
    else if (!(value < infinity) && says_it_holds(at, 1e-6))
      words << "does not hold at " << at;
    else if (value < infinity && !says_it_holds(at, -1e-6))
      words << "holds at " << at;
    return words.str().empty();
  };
  for (int k = 0; k <= samples; ++k)
    if (!check(found.angle * k / samples)) return words.str();
  for (const auto& stretch : found.unholdable)
    for (const double end : {stretch.from, stretch.to})
      for (const double beside : {-1.1e-6, 1.1e-6})
        if (end + beside >= 0 && end + beside <= found.angle && !check(end + beside))
          return words.str();
  return "";
}

TEST(SpaceTurn, PeakEnclosesDenseSamples) {
  std::map<std::string, int> tried;
  const bool all_right = rc::check([&] {
    if (!one_in(14)) return;
    const Case each = random_case();
    const Quaternion from(random_rotation());
    const Vector<3> to =
        one_in(8) ? Vector<3>(-(from.conjugate() * Vector<3>::UnitZ())) : random_direction();
    const TurnPeak<3> found = turn_peak(each.grasp, from, to, each.settings);
    RC_ASSERT(fault(each, from, to, found) == "");
    ++tried[found.unholdable.empty() ? "holdable" : "unholdable"];
  });
  EXPECT_TRUE(all_right);
  EXPECT_GT(tried["holdable"], 20);
  EXPECT_GT(tried["unholdable"], 20);
}

/// In plain arithmetic: no forces that balance a wrench have less effort than y and the rates of
/// drives with a max leave.
Real effort_bound(const Grasp<3>& grasp, const Wrench<3>& w, const Cut& cut) {
  Real bound = cut.y.cast<Real>().dot(w.cast<Real>());
  const std::vector<Drive<3>> drives = grasp.drives();
  std::vector<Twist<3>> y(grasp.fingers().size(), cut.y);
  for (std::size_t a = 0; cut.rates && a < drives.size(); ++a) {
    const double rate = (*cut.rates)[a];
    if (rate == 0) continue;
    bound -= Real{rate} * drives[a].max;
    for (const auto& moved : drives[a].moves)
      for (std::size_t f = 0; f < y.size(); ++f)
        if (grasp.fingers()[f] == moved.finger) y[f] -= rate * moved.twist;
  }
  for (std::size_t i = 0; i < grasp.contacts().size(); ++i) {
    const Contact<3>& contact = grasp.contacts()[i];
    const Twist<3>& felt = y[grasp.finger_of(i)];
    const Force f = answer_to(contact, felt);
    bound -= power(contact, f, felt) - cost(contact, f) / 2;
  }
  return 2 * bound;
}

/// The least that a cut leaves to a posture; infinite where it proves that it cannot be held.
double proven_by(const Case& each, const Cut& cut, const Vector<3>& up) {
  const Grasp<3>& grasp = each.grasp;
  if (cut.n) return cut.n->dot(up) > 0 ? infinity : 0;
  const Wrench<3> w = grasp.loads()[cut.load].at(up);
  const double weight = grasp.size();
  if (each.settings.objective == Objective::grip) {
    SmallVector<double, 4> rates(cut.rates->size());
    std::copy(cut.rates->begin(), cut.rates->end(), rates.begin());
    const double sum = std::accumulate(rates.begin(), rates.end(), 0.0);
    const double proven = grip_bound<3>(grasp, w, cut.y, rates, 1e6 * weight);
    if (sum < 1e-9) return proven > 0 ? infinity : 0;
    return proven / sum > most_grip<3>(grasp) ? infinity : proven / sum;
  }
  const bool has_pad = std::any_of(grasp.contacts().begin(), grasp.contacts().end(),
                                   [](const auto& contact) { return contact.pad.has_value(); });
  const double proven =
      has_pad ? bound<3>(grasp, w, cut.y) : static_cast<double>(effort_bound(grasp, w, cut));
  return proven > static_cast<double>(squared_cap(grasp, 1e6)) ? infinity : proven;
}

/// By which angle the directions from a to the points of a closed curve turn, seen from the point
/// opposite to infinity b: stereographic projection from b, counted in whole turns.
int winding_number(const std::vector<WallPart>& wall, const Vector<3>& a, const Vector<3>& b) {
  Eigen::Matrix3d frame;
  const Vector<3> u = b.unitOrthogonal();
  frame << u.transpose(), b.cross(u).transpose(), b.transpose();
  const auto project = [&](const Vector<3>& x) {
    const Vector<3> in_frame = frame * x.normalized();
    const double beyond = std::max(1 - in_frame.z(), 1e-300);
    return std::complex<double>(in_frame.x(), in_frame.y()) / beyond;
  };
  const std::complex<double> from = project(a);
  double turned = 0;
  for (std::size_t k = 0; k < wall.size(); ++k) {
    const Vector<3>&p = wall[k].up, &q = wall[(k + 1) % wall.size()].up;
    std::complex<double> before = project(p) - from;
    constexpr int steps = 2000;
    for (int i = 1; i <= steps; ++i) {
      const std::complex<double> next = project(p + (q - p) * i / steps) - from;
      turned += std::arg(next / before);
      before = next;
    }
  }
  return static_cast<int>(std::lround(turned / (2 * pi)));
}

/// The greatest value of samples of straight turns from each posture to the next.
double most_along(const Case& each, const Ups& ups, int samples) {
  double most = 0;
  for (std::size_t k = 0; k + 1 < ups.size(); ++k) {
    const Quaternion from = orientation_of(ups[k]);
    const Turn turn = turn_to(from, ups[k + 1]);
    for (int i = 0; i <= samples; ++i)
      most = std::max(most, each.value(on_turn(from, turn, turn.angle * i / samples)));
  }
  return most;
}

bool is_tilted_less(const Case& each, const Vector<3>& up) {
  const auto& tilt = each.settings.tilt;
  return !tilt || std::acos(std::clamp(up.dot(tilt->from), -1.0, 1.0)) <= tilt->most + 1e-7;
}

/// What is wrong with a way, or nothing.
std::string fault(const Case& each, const Vector<3>& from, const Vector<3>& to, const Way& way,
                  int samples = 100) {
  std::ostringstream words;
  words.precision(12);
  if (!(way.lower_bound <= way.peak)) return "the bound is above the peak";
  if (way.ups.empty() != !(way.peak < infinity)) return "no ups, or no peak";
  if (!way.ups.empty()) {
    if ((way.ups.front() - from).norm() > 1e-6 || (way.ups.back() - to).norm() > 1e-6)
      return "the ends";
    if (const double most = most_along(each, way.ups, samples);
        !(most <= way.peak * (1 + digits(each)))) {
      words << "a step needs " << most << ", more than " << way.peak;
      return words.str();
    }
    const bool stays = is_tilted_less(each, from) && is_tilted_less(each, to);
    for (const Vector<3>& up : way.ups)
      if (stays && !is_tilted_less(each, up)) return "a step leaves the domain";
    const double gap = (way.peak - way.lower_bound) / way.peak;
    const bool is_nothing = way.peak < 1e-5 * each.grasp.size();
    if (!is_nothing && (way.status == Status::optimal) != (gap <= each.settings.gap * (1 + 1e-6)))
      return "the status";
  } else if ((way.status == Status::unholdable) != !(way.lower_bound < infinity)) {
    return "the status of no way";
  }
  const TurnPeak<3> straight = turn_peak(each.grasp, from, to, each.settings);
  // Of opposite postures no turn is the straight one.
  if ((from + to).norm() > 1e-6 && is_tilted_less(each, from) &&
      !(way.peak <= straight.peak * (1 + 1e-9))) {
    words << "the way needs " << way.peak << ", the straight turn " << straight.peak;
    return words.str();
  }
  const double enough = way.lower_bound * (1 - 1e-8);
  if (way.wall.empty()) {
    if (!(std::max(each.value(from), each.value(to)) >= enough)) return "no wall";
    return "";
  }
  for (std::size_t k = 0; k < way.wall.size(); ++k) {
    const Vector<3>&p = way.wall[k].up, &q = way.wall[(k + 1) % way.wall.size()].up;
    if (std::abs(p.norm() - 1) > 1e-9) return "a part of the wall is no unit vector";
    for (int i = 0; i <= 40; ++i) {
      const Vector<3> up = (p + (q - p) * i / 40).normalized();
      if (const double proven = proven_by(each, way.wall[k].cut, up); !(proven >= enough)) {
        words << "part " << k << " of the wall proves " << proven << " of " << way.lower_bound;
        return words.str();
      }
    }
  }
  if (winding_number(way.wall, from, to) == 0) return "the wall separates nothing";
  return "";
}

TEST(SpaceTurn, WayIsProvenToTakeLeast) {
  std::map<Status, int> tried;
  const bool all_right = rc::check([&] {
    if (!one_in(20)) return;
    Case each = random_case();
    if (one_in(4)) each.settings.tilt = Tilt{random_direction(), real(0.2, pi / 2)};
    const Vector<3> from = random_direction(), to = random_direction();
    const Way way = least_peak_way(each.grasp, from, to, each.settings);
    RC_ASSERT(fault(each, from, to, way, 40) == "");
    ++tried[way.status];
  });
  EXPECT_TRUE(all_right);
  EXPECT_GT(tried[Status::optimal], 20);
  EXPECT_GT(tried[Status::unholdable], 10);
  EXPECT_LE(tried[Status::gap], 3);
}

/// A sphere of triangles, by halving the edges of an icosahedron.
struct Grid {
  Ups ups;
  std::vector<std::vector<int>> neighbours;

  explicit Grid(int halvings) {
    const double g = (1 + std::sqrt(5.0)) / 2;
    for (const double a : {-1.0, 1.0})
      for (const double b : {-g, g})
        for (int k = 0; k < 3; ++k) {
          Vector<3> up;
          up[k] = 0;
          up[(k + 1) % 3] = a;
          up[(k + 2) % 3] = b;
          ups.push_back(up.normalized());
        }
    std::vector<std::array<int, 3>> faces;
    const auto are_near = [&](int a, int b) { return (at(a) - at(b)).norm() < 1.1; };
    for (int a = 0; a < 12; ++a)
      for (int b = 0; b < a; ++b)
        for (int c = 0; c < b; ++c)
          if (are_near(a, b) && are_near(b, c) && are_near(a, c)) faces.push_back({a, b, c});
    for (; halvings > 0; --halvings) {
      std::map<std::pair<int, int>, int> middles;
      const auto middle = [&](int a, int b) {
        const auto [found, is_new] =
            middles.try_emplace(std::minmax(a, b), static_cast<int>(ups.size()));
        if (is_new) ups.push_back((at(a) + at(b)).normalized());
        return found->second;
      };
      std::vector<std::array<int, 3>> finer;
      for (const auto& [a, b, c] : faces) {
        const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
      }
      faces = finer;
    }
    neighbours.resize(ups.size());
    for (const auto& face : faces)
      for (std::size_t k = 0; k < 3; ++k)
        neighbours[static_cast<std::size_t>(face[k])].push_back(face[(k + 1) % 3]);
  }

  const Vector<3>& at(int k) const { return ups[static_cast<std::size_t>(k)]; }
  int nearest(const Vector<3>& up) const {
    return static_cast<int>(
        std::max_element(ups.begin(), ups.end(),
                         [&](const auto& a, const auto& b) { return a.dot(up) < b.dot(up); }) -
        ups.begin());
  }
};

/// From a point of the grid, along edges: the least level at which each point is reached, and from
/// where.
struct Flood {
  std::vector<double> values, levels;
  std::vector<int> before;

  Flood(const Case& each, const Grid& grid, int from)
      : levels(grid.ups.size(), infinity), before(grid.ups.size(), -1) {
    for (const Vector<3>& up : grid.ups)
      values.push_back(is_tilted_less(each, up) ? each.value(up) : infinity);
    std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>>
        open;
    const auto reach = [&](int k, int by, double level) {
      const auto at = static_cast<std::size_t>(k);
      level = std::max(level, values[at]);
      if (!(level < levels[at])) return;
      levels[at] = level;
      before[at] = by;
      open.push({level, k});
    };
    reach(from, -1, 0);
    while (!open.empty()) {
      const auto [level, k] = open.top();
      open.pop();
      if (level > levels[static_cast<std::size_t>(k)]) continue;
      for (const int next : grid.neighbours[static_cast<std::size_t>(k)]) reach(next, k, level);
    }
  }

  Ups way(const Grid& grid, int to) const {
    Ups ups;
    for (int k = to; k >= 0; k = before[static_cast<std::size_t>(k)]) ups.push_back(grid.at(k));
    return ups;
  }
};

/// Of the paths along the edges of a fine grid none needs less than the bound, and none less than
/// the peak; the least is near to it.
void check_against_grid(const Case& each, const Vector<3>& near_from, const Vector<3>& near_to) {
  const Grid grid(4);
  ASSERT_EQ(grid.ups.size(), 2562U);
  const int start = grid.nearest(near_from), end = grid.nearest(near_to);
  const Vector<3>&from = grid.at(start), &to = grid.at(end);
  const Way way = least_peak_way(each.grasp, from, to, each.settings);
  EXPECT_EQ(fault(each, from, to, way), "");
  const Flood flood(each, grid, start);
  const double level = flood.levels[static_cast<std::size_t>(end)];
  if (!(level < infinity)) return;  // ways may be narrower than the grid
  ASSERT_LT(way.peak, infinity);
  EXPECT_EQ(way.status, Status::optimal);
  const double most = most_along(each, flood.way(grid, end), 20);
  EXPECT_GE(most, way.lower_bound * (1 - 1e-5));
  EXPECT_LE(way.peak, most / (1 - each.settings.gap) * (1 + 1e-5));
  EXPECT_GE(way.peak, level * 0.8);
}

TEST(SpaceTurn, WayIsNoWorseThanThoseAlongAFineGrid) {
  const bool all_right = rc::check([&] {
    if (!one_in(200)) return;
    const auto kind = static_cast<Kind>(pick(0, static_cast<int>(Kind::loads)));
    const Case each = random_case(kind, static_cast<std::size_t>(pick(3, 6)),
                                  one_in(4) ? Objective::grip : Objective::effort);
    check_against_grid(each, random_direction(), random_direction());
    RC_ASSERT(!testing::Test::HasFailure());
  });
  EXPECT_TRUE(all_right);
}

/// Which postures can be reached without pressing harder, by flooding a fine grid.
TEST(SpaceTurn, BestReachableIsThatOfAFloodedGrid) {
  const bool all_right = rc::check([&] {
    if (!one_in(200)) return;
    const auto kind = static_cast<Kind>(pick(0, static_cast<int>(Kind::loads)));
    const Case each = random_case(kind, static_cast<std::size_t>(pick(3, 6)),
                                  one_in(4) ? Objective::grip : Objective::effort);
    const Grid grid(4);
    const int start = grid.nearest(random_direction());
    const Vector<3>& from = grid.at(start);
    const double now = each.value(from);
    if (!(now < infinity)) return;
    const Reachable<3> found = best_reachable(each.grasp, from, random_direction(), each.settings);
    const double value = found.posture.value();
    RC_ASSERT(value <= now && found.lower_bound <= value);
    RC_ASSERT(close(value, each.value(found.posture.up), digits(each)));
    RC_ASSERT((found.way.status == Status::optimal) ==
              (value - found.lower_bound <= each.settings.gap * value * (1 + 1e-6)));
    RC_ASSERT((found.way.ups.back() - found.posture.up).norm() < 1e-9);
    const double allowed = now / (1 - each.settings.gap) * (1 + digits(each));
    RC_ASSERT(found.way.peak <= allowed);
    RC_ASSERT(most_along(each, found.way.ups, 400) <= allowed);
    const Flood flood(each, grid, start);
    for (std::size_t k = 0; k < grid.ups.size(); ++k)
      if (flood.levels[k] <= now && flood.values[k] < found.lower_bound * (1 - digits(each)))
        RC_ASSERT(most_along(each, flood.way(grid, static_cast<int>(k)), 20) > now);
    RC_ASSERT(found.way.status == Status::optimal);
  });
  EXPECT_TRUE(all_right);
}

/// A turn of 5 N, with what a cone solver says of it that shares no code with the project.
struct Replay {
  Vector<3> com;
  std::vector<Contact<3>> contacts;
  DriveKind drives;
  Vector<3> from, to;
  double now, then;        ///< grips [N]
  double peak, at, angle;  ///< of the straight turn [N, degrees], from samples
  double way;              ///< [N], the least found along the edges of a grid
};

TEST(SpaceTurn, OfFiveHandsIsAsAConeSolverSays) {
  const std::vector<Replay> replays = {
      {{-0.01521, -0.010316, -0.014734},
       {
           contact({0.039783, 1.5e-05, 0.00416}, {-0.989695, 0.138285, -0.037154}, 0.749),
           contact({-0.01867, 0.03103, 0.016987}, {0.538844, -0.680499, -0.496556}, 0.511),
           contact({-0.017966, -0.033523, -0.012386}, {0.452284, 0.731756, 0.509876}, 0.717),
       },
       DriveKind::each,
       {0.324863529009311, -0.33920884365286597, 0.8828369316625251},
       {-0.513375, -0.646578, -0.564254},
       3.5315,
       3.0097,
       4.0658,
       36,
       116,
       3.9745},
      {{0.000884, 0.00051, -0.0098},
       {
           contact({0.036977, -0.014779, 0.003781}, {-0.889115, 0.37285, 0.265437}, 0.767),
           contact({-0.019479, 0.034901, 0.001585}, {0.663466, -0.741598, 0.099222}, 0.677),
           contact({-0.007848, -0.037684, -0.010879}, {0.221401, 0.891225, 0.395853}, 0.507),
       },
       DriveKind::each,
       {-0.4602665871034953, 0.8658710614766665, -0.19601523842133134},
       {0.399607, 0.082324, 0.912982},
       2.5188,
       2.314,
       2.685,
       24,
       107,
       2.6637},
      {{0.009162, -0.010588, -0.006357},
       {
           contact({0.036113, 0.000825, 0.01718}, {-0.817977, -0.182352, -0.545583}, 0.749),
           contact({-0.021826, 0.031895, 0.010311}, {0.636668, -0.709499, -0.302102}, 0.46),
           contact({-0.039153, -0.008136, -0.000931}, {0.989996, -0.013959, 0.140403}, 0.655),
           contact({-0.005536, -0.039575, 0.00178}, {0.282089, 0.959294, -0.013432}, 0.439),
       },
       DriveKind::each,
       {0, 0.1379522421276337, 0.9904388819568619},
       {0.606825, -0.237086, -0.758652},
       6.1663,
       1.689,
       6.24851,
       10,
       142,
       6.1663},
      {{0.002821, -0.000966, -0.001578},
       {
           contact({0.032194, 0.006328, -0.02288}, {-0.804855, -0.15819, 0.572001}, 0.778, 0.006),
           contact({-0.03948, 0.003888, -0.005118}, {0.987007, -0.097201, 0.127941}, 0.621, 0.006),
       },
       DriveKind::each,
       {0.7388862662636194, 0.6628419463448338, -0.12119257276252594},
       {0.259892, -0.433889, 0.862668},
       9.3173,
       2.4397,
       9.31734,
       0,
       102,
       9.3173},
      {{0.017958, -0.006654, -0.004992},
       {
           contact({0.037786, -0.013121, -0.000161}, {-0.979712, 0.170824, -0.104798}, 0.75),
           contact({-0.026313, 0.029754, -0.004725}, {0.557971, -0.829157, 0.034163}, 0.549),
           contact({-0.01403, -0.03145, -0.020348}, {0.529195, 0.671078, 0.519238}, 0.609),
       },
       DriveKind::coupled,
       {-0.1960152384213314, -0.46026658710349533, -0.8658710614766665},
       {-0.506298, 0.859848, 0.065758},
       2.8124,
       1.5262,
       2.81244,
       0,
       111,
       2.8124},
  };
  for (const Replay& replay : replays) {
    Mechanism<3> mechanism;
    mechanism.kind = replay.drives;
    const Case each{{Load<3>{5, replay.com}, replay.contacts, 1, mechanism},
                    {.objective = Objective::grip}};
    const Vector<3> from = replay.from.normalized(), to = replay.to.normalized();
    EXPECT_NEAR(each.value(from), replay.now, 1e-4);
    EXPECT_NEAR(each.value(to), replay.then, 1e-4);
    const TurnPeak<3> straight = turn_peak(each.grasp, from, to, each.settings);
    EXPECT_GE(straight.peak, replay.peak * (1 - 1e-5));
    EXPECT_LE(straight.lower_bound, replay.peak * (1 + 1e-4));
    EXPECT_NEAR(straight.at * 180 / pi, replay.at, 2);
    EXPECT_NEAR(straight.angle * 180 / pi, replay.angle, 0.5);
    EXPECT_EQ(fault(each, orientation_of(from), to, straight), "");
    const Way way = least_peak_way(each.grasp, from, to, each.settings);
    EXPECT_EQ(fault(each, from, to, way), "");
    EXPECT_EQ(way.status, Status::optimal);
    EXPECT_LE(way.lower_bound, replay.way * (1 + 1e-4));
    EXPECT_LE(way.peak, replay.way * (1 + 1e-3));
    EXPECT_GE(way.peak, replay.way * 0.9);
  }
}

/// Fingers at both ends of an axis through the com. They must press with |n| = W |cos a| / 2 each
/// and friction carries W sin a in equal parts.
Case jaws(double friction, double most = infinity, Objective objective = Objective::grip) {
  std::vector<Contact<3>> fingers{contact({0, 0, -1}, {0, 0, 1}, friction),
                                  contact({0, 0, 1}, {0, 0, -1}, friction)};
  for (Contact<3>& finger : fingers) finger.max_normal = most;
  return {Grasp<3>(Load<3>{.weight = 10}, fingers), {.objective = objective}};
}

/// At an angle a from the axis the grip is W sin a / (2 mu) + W |cos a|.
TEST(SpaceTurn, OfTwoFingersHasAPeakInClosedForm) {
  const double mu = 0.5;
  const Case each = jaws(mu);
  const double top = std::atan(1 / (2 * mu)), peak = 10 * std::hypot(1 / (2 * mu), 1);
  const Vector<3> across(0.6, 0.8, 0);
  const TurnPeak<3> quarter = turn_peak(each.grasp, Vector<3>::UnitZ(), across, each.settings);
  EXPECT_NEAR(quarter.at, top, 0.05);
  EXPECT_GE(quarter.peak, peak * (1 - 1e-9));
  EXPECT_LE(quarter.lower_bound, peak * (1 + 1e-9));
  EXPECT_EQ(fault(each, orientation_of(Vector<3>::UnitZ()), across, quarter), "");
  // About the axis nothing changes.
  const TurnPeak<3> about = turn_peak(each.grasp, across, Vector<3>(-0.8, 0.6, 0), each.settings);
  EXPECT_NEAR(about.peak, 10 / (2 * mu), 1e-3 * 10);
  EXPECT_GE(about.peak, 10 / (2 * mu) * (1 - 1e-9));
  // No way leads from the axis across it but over the ring where most is needed.
  const Way way = least_peak_way(each.grasp, Vector<3>::UnitZ(), across, each.settings);
  EXPECT_EQ(fault(each, Vector<3>::UnitZ(), across, way), "");
  EXPECT_EQ(way.status, Status::optimal);
  EXPECT_LE(way.lower_bound, peak * (1 + 1e-9));
  EXPECT_GE(way.peak, peak * (1 - 1e-9));
  // From one end of the axis to the other: all ways are equal.
  const Way over =
      least_peak_way(each.grasp, Vector<3>::UnitZ(), -Vector<3>::UnitZ(), each.settings);
  EXPECT_EQ(fault(each, Vector<3>::UnitZ(), -Vector<3>::UnitZ(), over), "");
  EXPECT_EQ(over.status, Status::optimal);
}

/// Fingers that may not press hard: two caps of postures that hold, round the ends of the axis.
TEST(SpaceTurn, IsRefutedByAWallBetweenTwoParts) {
  const double mu = 0.3, most = 12;
  // sin a / (2 mu) + cos a <= most / W
  const double width = std::atan(1 / (2 * mu)) - std::acos(most / 10 / std::hypot(1 / (2 * mu), 1));
  for (const Objective objective : {Objective::grip, Objective::effort})
    for (const bool by_drives : {false, true}) {
      if (by_drives && objective == Objective::effort) continue;
      Case each = jaws(mu, by_drives ? infinity : most, objective);
      if (by_drives) {
        Mechanism<3> mechanism;
        for (const std::string& name : each.grasp.fingers())
          mechanism.fingers.push_back({.name = name, .max_force = most});
        each.grasp = Grasp<3>(each.grasp.loads(), each.grasp.contacts(), 1, mechanism);
      }
      const Vector<3> from(0.03, 0.01, 1), to(0.02, 0, -1);
      const Way way = least_peak_way(each.grasp, from.normalized(), to.normalized(), each.settings);
      EXPECT_EQ(way.status, Status::unholdable);
      EXPECT_TRUE(way.ups.empty());
      EXPECT_FALSE(way.wall.empty());
      EXPECT_EQ(fault(each, from.normalized(), to.normalized(), way), "");
      const TurnPeak<3> quarter =
          turn_peak(each.grasp, Vector<3>::UnitZ(), Vector<3>::UnitX(), each.settings);
      ASSERT_EQ(quarter.unholdable.size(), 1U);
      EXPECT_NEAR(quarter.unholdable[0].from, width, 2e-6);
      EXPECT_NEAR(quarter.unholdable[0].to, pi / 2, 1e-9);
      // From a posture that cannot be held there is no way, and no wall is needed.
      const Way none =
          least_peak_way(each.grasp, Vector<3>::UnitX(), to.normalized(), each.settings);
      EXPECT_EQ(none.status, Status::unholdable);
      EXPECT_TRUE(none.wall.empty());
      EXPECT_THROW(best_reachable(each.grasp, Vector<3>::UnitX(), to.normalized(), each.settings),
                   InvalidGrasp);
      // What can be reached is the near cap.
      const Reachable<3> found =
          best_reachable(each.grasp, from.normalized(), to.normalized(), each.settings);
      EXPECT_EQ(found.way.status, Status::optimal);
      EXPECT_GT(found.posture.up.z(), 0.9);
    }
}

/// A band of postures whose ends the domain cuts off from each other.
TEST(SpaceTurn, StaysWithinTheTilt) {
  Case each = jaws(0.3, 12);
  each.settings.tilt = Tilt{Vector<3>::UnitZ(), 0.05};
  const Vector<3> from = Vector<3>(0.04, 0, 1).normalized(),
                  to = Vector<3>(0, 0.045, 1).normalized();
  const Way way = least_peak_way(each.grasp, from, to, each.settings);
  EXPECT_EQ(fault(each, from, to, way), "");
  EXPECT_EQ(way.status, Status::optimal);
  // One posture.
  each.settings.tilt->most = 0;
  const Way none =
      least_peak_way(each.grasp, Vector<3>::UnitZ(), Vector<3>::UnitZ(), each.settings);
  EXPECT_EQ(none.status, Status::optimal);
  EXPECT_NEAR(none.peak, 10, 1e-6);
  // From outside of the domain it does not matter.
  const Way outside = least_peak_way(each.grasp, from, to, each.settings);
  EXPECT_NEAR(outside.peak, way.peak, 2e-3 * way.peak);
}

/// Hard fingers on a line beside the com hold only in a plane: there are two ways round.
TEST(SpaceTurn, OfTwoHardFingersGoesRoundOneWayOrTheOther) {
  std::vector<Contact<2>> flat(2);
  flat[0].position = {1, 0};
  flat[0].normal = {-1, 0};
  flat[1].position = {-1, 0};
  flat[1].normal = {1, 0};
  flat[0].friction = flat[1].friction = 2;
  const Grasp<2> plane({10, {0.1, 0.2}}, flat);
  for (const Objective objective : {Objective::grip, Objective::effort})
    for (const double start : {0.3, 2.0, -1.0})
      for (const double end : {1.2, -2.5, 2.9}) {
        const Case each{{Load<3>{10, {0.1, 0.2, 0}},
                         {contact({1, 0, 0}, {-1, 0, 0}, 2), contact({-1, 0, 0}, {1, 0, 0}, 2)}},
                        {.objective = objective}};
        const Vector<3> from(std::sin(start), std::cos(start), 0),
            to(std::sin(end), std::cos(end), 0);
        const auto ways = ways_round(plane, start, end, {.objective = objective});
        ASSERT_EQ(ways.size(), 2U);
        const Way way = least_peak_way(each.grasp, from, to, each.settings);
        EXPECT_EQ(fault(each, from, to, way), "");
        EXPECT_EQ(way.status, Status::optimal);
        EXPECT_GE(way.peak, ways[0].peak * (1 - 1e-6));
        EXPECT_LE(way.lower_bound, ways[0].peak * (1 + 1e-6));
        const TurnPeak<3> straight = turn_peak(each.grasp, from, to, each.settings);
        const TurnPeak<2>& same = std::abs(ways[0].angle) < pi ? ways[0] : ways[1];
        EXPECT_GE(straight.peak, same.peak * (1 - 1e-6));
        EXPECT_LE(straight.lower_bound, same.peak * (1 + 1e-6));
      }
}

/// Of flat hands a turn in their plane is that of the plane.
TEST(SpaceTurn, OfFlatHandsIsThatOfThePlane) {
  const bool all_right = rc::check([&] {
    if (!one_in(20)) return;
    const test::Held flat =
        *test::grasps({.least_contacts = 2, .most_contacts = 5, .awkward = false});
    std::vector<Contact<3>> contacts;
    for (const Contact<2>& c : flat.contacts) {
      Contact<3> finger =
          contact({c.position.x(), c.position.y(), 0}, {c.normal.x(), c.normal.y(), 0}, c.friction);
      finger.min_normal = c.min_normal;
      finger.max_normal = c.max_normal;
      finger.share = c.share;
      contacts.push_back(finger);
    }
    const Load<3> load{flat.object.weight, {flat.object.com.x(), flat.object.com.y(), 0}};
    const Case each{{load, contacts},
                    {.objective = one_in(2) ? Objective::grip : Objective::effort}};
    if (each.settings.objective == Objective::grip && !has_grip<2>(flat.grasp())) return;
    const double from = random_angle(), angle = 3 * coordinate();
    const auto up = [](double theta) { return Vector<3>(std::sin(theta), std::cos(theta), 0); };
    const TurnPeak<2> plane =
        turn_peak(flat.grasp(), from, angle, {.objective = each.settings.objective});
    const TurnPeak<3> space = turn_peak(each.grasp, up(from), up(from + angle), each.settings);
    if (!(plane.peak < infinity)) {
      double widest = 0;
      for (const auto& stretch : plane.unholdable)
        widest = std::max(widest, std::abs(stretch.to - stretch.from));
      RC_ASSERT(widest < 1e-6 || !(space.peak < infinity));
      return;
    }
    if (plane.peak > 1e6 * flat.object.weight) return;  // beside what cannot be held
    RC_ASSERT(space.peak >= plane.peak * (1 - 1e-6));
    RC_ASSERT(space.lower_bound <= plane.peak * (1 + 1e-6) + 1e-9);
  });
  EXPECT_TRUE(all_right);
}

TEST(SpaceTurn, TurnToLeadsThere) {
  for (const Vector<3>& up : directions(40)) {
    const Quaternion from(Eigen::AngleAxisd(2.1, Vector<3>(0.48, 0.6, 0.64)));
    const Turn turn = turn_to(from, up);
    EXPECT_NEAR((turn.orientation * up - Vector<3>::UnitZ()).norm(), 0, 1e-12);
    EXPECT_NEAR((on_turn(from, turn, turn.angle) - up).norm(), 0, 1e-12);
    EXPECT_GE(turn.orientation.w(), 0);
    EXPECT_NEAR(turn.axis.norm(), 1, 1e-12);
    EXPECT_NEAR((orientation_of(up) * up - Vector<3>::UnitZ()).norm(), 0, 1e-12);
  }
  const Turn down = turn_to(Quaternion::Identity(), -Vector<3>::UnitZ());
  EXPECT_NEAR(down.angle, pi, 1e-12);
  EXPECT_NEAR((down.axis - Vector<3>::UnitX()).norm(), 0, 1e-12);
}

Case four_fingers(Objective objective = Objective::effort) {
  std::vector<Contact<3>> fingers;
  for (int k = 0; k < 4; ++k) {
    const Vector<3> at =
        Vector<3>(std::cos(1.6 * k), std::sin(1.6 * k), 0.4 * k - 0.5).normalized();
    fingers.push_back(contact(at, -at, 0.6));
  }
  return {Grasp<3>(Load<3>{1, {0.1, 0, 0.05}}, fingers), {.objective = objective}};
}

TEST(SpaceTurn, OfNoAngleOrAlmostNoneIsWhereItIs) {
  for (const Objective objective : {Objective::grip, Objective::effort}) {
    const Case each = four_fingers(objective);
    for (const double angle : {0.0, 1e-15, 1e-12, 1e-9, 1e-6}) {
      const Vector<3> from = Vector<3>(0.1, 0.2, 1).normalized();
      const Vector<3> to = (from + angle * from.unitOrthogonal()).normalized();
      const double now = each.value(from);
      const TurnPeak<3> found = turn_peak(each.grasp, from, to, each.settings);
      EXPECT_NEAR(found.peak, now, 1e-4 * now) << angle;
      EXPECT_TRUE(found.unholdable.empty());
      const Way way = least_peak_way(each.grasp, from, to, each.settings);
      EXPECT_EQ(way.status, Status::optimal) << angle;
      EXPECT_NEAR(way.peak, now, 1e-4 * now) << angle;
      const Reachable<3> reachable = best_reachable(each.grasp, from, to, each.settings);
      EXPECT_EQ(reachable.way.status, Status::optimal) << angle;
      EXPECT_LE(reachable.posture.value(), now);
    }
  }
}

TEST(SpaceTurn, UpsideDownIsAboutTheWorldsX) {
  const Case each = four_fingers();
  for (const Vector<3>& axis : directions(5)) {
    const Quaternion from(Eigen::AngleAxisd(1.1, axis));
    const Vector<3> to = -(from.conjugate() * Vector<3>::UnitZ());
    const TurnPeak<3> found = turn_peak(each.grasp, from, to, each.settings);
    EXPECT_NEAR(found.angle, pi, 1e-9);
    EXPECT_EQ(fault(each, from, to, found), "");
    const Way way = least_peak_way(each.grasp, -to, to, each.settings);
    EXPECT_EQ(way.status, Status::optimal);
    EXPECT_EQ(fault(each, -to, to, way), "");
  }
}

TEST(SpaceTurn, EndsWithFewHoldsAndSmallGaps) {
  Case each = four_fingers();
  const Vector<3> from = Vector<3>(0.1, 0.2, 1).normalized(), to(0.6, 0, -0.8);
  for (const int holds : {1, 2, 5, 30, 200}) {
    each.settings.max_holds = holds;
    const TurnPeak<3> found = turn_peak(each.grasp, from, to, each.settings);
    EXPECT_LE(found.lower_bound, found.peak);
    const Way way = least_peak_way(each.grasp, from, to, each.settings);
    EXPECT_LE(way.lower_bound, way.peak);
    EXPECT_EQ(fault(each, from, to, way), "") << holds;
    best_reachable(each.grasp, from, to, each.settings);
  }
  each.settings.max_holds = 20000;
  each.settings.gap = 1e-9;
  const TurnPeak<3> found = turn_peak(each.grasp, from, to, each.settings);
  EXPECT_LE(found.peak - found.lower_bound, 1e-9 * found.peak);
  each.settings.max_holds = 3000;
  const Way way = least_peak_way(each.grasp, from, to, each.settings);
  EXPECT_EQ(fault(each, from, to, way), "");
}

/// An object that lies on fixed fingers: no drive needs to do anything.
TEST(SpaceTurn, OfWhatNeedsNothingHasThePeakZero) {
  std::vector<Contact<3>> fingers;
  for (int k = 0; k < 3; ++k) {
    const Vector<3> at(std::cos(2 * pi * k / 3), std::sin(2 * pi * k / 3), -0.5);
    fingers.push_back(contact(at, {0, 0, 1}, 1));
    fingers.back().finger = "tray";
  }
  fingers.push_back(contact({0, 0, 1}, {0, 0, -1}, 1));
  fingers.back().finger = "above";
  Mechanism<3> mechanism;
  mechanism.kind = DriveKind::listed;
  Twist<3> down;
  down << 0, 0, -1, 0, 0, 0;
  mechanism.drives.push_back({.name = "jaw", .moves = {{"above", down}}});
  const Case each{{Load<3>{.weight = 1}, fingers, 1, mechanism}, {.objective = Objective::grip}};
  const Vector<3> from = Vector<3>(0.2, 0, 1).normalized(),
                  to = Vector<3>(-0.2, 0.1, 1).normalized();
  const TurnPeak<3> found = turn_peak(each.grasp, from, to, each.settings);
  EXPECT_NEAR(found.peak, 0, 1e-9);
  EXPECT_TRUE(found.unholdable.empty());
  const Way way = least_peak_way(each.grasp, from, to, each.settings);
  EXPECT_EQ(way.status, Status::optimal);
  EXPECT_NEAR(way.peak, 0, 1e-9);
  const Reachable<3> reachable = best_reachable(each.grasp, from, to, each.settings);
  EXPECT_EQ(reachable.way.status, Status::optimal);
  EXPECT_LT(way.holds + reachable.way.holds, 2000);
}

TEST(SpaceTurn, OfManyContactsIsFound) {
  std::vector<Contact<3>> fingers;
  for (const Vector<3>& at : directions(200)) fingers.push_back(contact(at, -at, 0.4));
  const Case each{{Load<3>{1, {0.1, 0.1, 0.2}}, fingers}};
  const Vector<3> from(0, 0.6, 0.8), to(0, 0.6, -0.8);
  const TurnPeak<3> found = turn_peak(each.grasp, from, to, each.settings);
  EXPECT_EQ(fault(each, orientation_of(from), to, found, 50), "");
  const Way way = least_peak_way(each.grasp, from, to, each.settings);
  // So many fingers need much the same in every posture: a bound within 1e-3 takes more holds.
  EXPECT_GE(way.lower_bound, 0.98 * way.peak);
  EXPECT_EQ(fault(each, from, to, way, 10), "");
}

TEST(SpaceTurn, RefusesMisuse) {
  const Case each = four_fingers();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Vector<3> up(0, 0, 1);
  for (const Vector<3>& bad : {Vector<3>(0, 0, 0), Vector<3>(nan, 0, 1), Vector<3>(0, 0, 2)}) {
    EXPECT_THROW(turn_peak(each.grasp, up, bad), InvalidGrasp);
    EXPECT_THROW(turn_peak(each.grasp, bad, up), InvalidGrasp);
    EXPECT_THROW(turn_peak(each.grasp, Quaternion::Identity(), bad), InvalidGrasp);
    EXPECT_THROW(least_peak_way(each.grasp, bad, up), InvalidGrasp);
    EXPECT_THROW(least_peak_way(each.grasp, up, bad), InvalidGrasp);
    EXPECT_THROW(best_reachable(each.grasp, bad, up), InvalidGrasp);
    EXPECT_THROW(best_reachable(each.grasp, up, bad), InvalidGrasp);
  }
  EXPECT_THROW(turn_peak(each.grasp, Quaternion(0, 0, 0, 0), up), InvalidGrasp);
  EXPECT_THROW(turn_peak(each.grasp, Quaternion(nan, 0, 0, 0), up), InvalidGrasp);
  for (const double gap : {0.0, 1.0, nan}) {
    EXPECT_THROW(turn_peak(each.grasp, up, up, {.gap = gap}), InvalidGrasp);
    EXPECT_THROW(least_peak_way(each.grasp, up, up, {.gap = gap}), InvalidGrasp);
    EXPECT_THROW(best_reachable(each.grasp, up, up, {.gap = gap}), InvalidGrasp);
  }
  EXPECT_THROW(least_peak_way(each.grasp, up, up, {.max_holds = 0}), InvalidGrasp);
}

}  // namespace
}  // namespace poise::test::space
