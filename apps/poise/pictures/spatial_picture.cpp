#include <algorithm>
#include <cmath>
#include <numbers>

#include "pictures/body.hpp"
#include "pictures/canvas.hpp"
#include "pictures/other_load.hpp"
#include "pictures/pictures.hpp"
#include "pictures/plot.hpp"
#include "pictures/script.hpp"
#include "poise/turn.hpp"
#include "tables/table.hpp"

namespace poise {
namespace {

using std::numbers::pi;

// The picture [points]; the object is drawn between the title and the legend.
constexpr double page_width = 900, page_height = 720, top = 92, bottom = 60, side = 120;
constexpr double per_point = 3;  // pixels of the body, two to a pixel of its image

/// Seen from above by 18 degrees, the world's azimuth as given.
View view_from(double azimuth, const Eigen::Quaterniond& orientation) {
  constexpr double above = 18 * pi / 180;
  const double c = std::cos(azimuth), s = std::sin(azimuth);
  const Eigen::Quaterniond back = orientation.conjugate();
  View view;
  view.right = back * Vector<3>(-s, c, 0);
  view.toward = back * Vector<3>(c * std::cos(above), s * std::cos(above), std::sin(above));
  view.upwards = view.toward.cross(view.right);
  view.centre.setZero();
  view.middle = {page_width / 2, (top + page_height - bottom) / 2};
  return view;
}

/// One arrow: the force of a finger on the object, whose head is at the contact.
struct Push {
  std::size_t contact;
  Vector<3> tail, head;
  bool hidden{false}, limited{false}, by_pad{false};
};

/// All that is drawn.
struct Picture {
  const Grasp<3>& grasp;
  const Load<3>& load;
  const Hold<3>& hold;
  Mesh mesh;
  double size;  ///< half of the largest extent of all that is fixed [m]
  std::vector<Push> pushes;
  Vector<3> weight;  ///< tip of its arrow
  double cone_length;
  OtherLoad<3> other;
  std::vector<Vector<3>> other_arrow{};  ///< from its tail to its tip; round of a moment alone
};

Picture picture_of(const SpatialFile& file, const Grasp<3>& grasp, const Posture<3>& posture) {
  const Load<3>& load = grasp.loads()[posture.decides];
  Picture picture{
      grasp, load, posture.hold(),           file.shape ? mesh_of(*file.shape) : Mesh{}, 0, {},
      {},    0,    {grasp, load, posture.up}};
  Eigen::AlignedBox3d box(load.com);
  for (const Vector<3>& vertex : picture.mesh.vertices) box.extend(vertex);
  for (const Contact<3>& contact : grasp.contacts()) box.extend(contact.position);
  picture.size = box.diagonal().norm() / 2;
  if (!(picture.size > 0)) picture.size = 1;
  const std::size_t count = grasp.contacts().size();
  picture.cone_length =
      picture.size * 0.5 / std::sqrt(std::max(1.0, static_cast<double>(count) / 4));

  // Forces to one scale; the weight stays visible beside forces much larger than it.
  const double weight = load.weight;
  double largest = std::max(weight, picture.other.force.norm());
  for (std::size_t i = 0; i < picture.hold.forces.size(); ++i)
    largest = std::max(largest, force_vector(grasp.contacts()[i], picture.hold.forces[i]).norm());
  const double scale = 0.8 * picture.size / largest;
  for (std::size_t i = 0; i < picture.hold.forces.size(); ++i) {
    const ContactForce<3>& force = picture.hold.forces[i];
    if (force.state == ContactState::unloaded) continue;
    const Vector<3> at = grasp.contacts()[i].position + force.center_of_pressure;
    picture.pushes.push_back({.contact = i,
                              .tail = at - scale * force_vector(grasp.contacts()[i], force),
                              .head = at,
                              .limited = force.limit != ForceLimit::none,
                              .by_pad = grasp.contacts()[i].pad.has_value()});
  }
  picture.weight = load.com - std::max(scale * weight, 0.25 * picture.size) * posture.up;
  const OtherLoad<3>& other = picture.other;
  if (other.pushes) {
    picture.other_arrow = {other.from, other.from + scale * other.force};
  } else if (other.turns) {
    const Eigen::Matrix<double, 3, 2> t =
        0.5 * picture.size * tangents(Vector<3>(other.moment.normalized()));
    picture.other_arrow = round_arrow<3>(other.from, t.col(0), t.col(1));
  }
  return picture;
}

/// Whether the object hides the finger: what is half a cone away from the contact.
bool hidden(const Picture& picture, const ShadedBody& body, const Contact<3>& contact) {
  return body.hides(contact.position - 0.5 * picture.cone_length * contact.normal,
                    0.005 * picture.size);
}

/// The azimuth that shows contacts apart, before the object, and their forces from the side.
double best_azimuth(const Picture& picture, const Eigen::Quaterniond& orientation) {
  constexpr int pixels = 160;
  double best = 0, best_score = -1e300;
  for (int k = 0; k < 36; ++k) {
    const double azimuth = -pi / 3 + 2 * pi * k / 36;
    View view = view_from(azimuth, orientation);
    view.centre = picture.load.com;
    view.middle = {pixels / 2.0, pixels / 2.0};
    view.scale = pixels / (4 * picture.size);
    const ShadedBody body(picture.mesh, view, pixels, pixels);
    const auto& contacts = picture.grasp.contacts();
    double least = 0, most = 0;  // of the object, to the right
    for (const Vector<3>& vertex : picture.mesh.vertices) {
      const double along = (vertex - view.centre).dot(view.right);
      least = std::min(least, along);
      most = std::max(most, along);
    }
    double score = 0.02 * std::cos(azimuth + pi / 3);
    // Not straight from one side: a box would look flat.
    score += 0.3 * view.toward.cwiseAbs().cwiseMin(0.3).sum();
    score += 0.3 * (most - least) / picture.size;  // an object tells most from its broad side
    if (picture.other.pushes) {
      const double along = picture.other.force.normalized().dot(view.toward);
      score -= along * along;  // an arrow is to be seen from its side
    } else if (picture.other.turns) {
      const double along = picture.other.moment.normalized().dot(view.toward);
      score += along * along;  // and a round one from its axis
    }
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const auto count = static_cast<double>(contacts.size());
      const double away = contacts[i].normal.dot(view.toward);  // behind the object if above 0
      const double turned = std::abs(away) - 0.35;  // a pad is to be seen, not only its edge
      score -= (hidden(picture, body, contacts[i]) ? 0.5 : 0) / count +
               0.6 * turned * turned / count + 0.1 * std::max(away, 0.0) / count;
      // Not before or behind the arrow of the weight.
      const double beside = std::abs((contacts[i].position - view.centre).dot(view.right));
      score -= 2 * std::max(0.0, 0.25 - beside / picture.size) / count;
      double nearest = 1;
      for (const Contact<3>& other : contacts)
        if (other.finger != contacts[i].finger)
          nearest =
              std::min(nearest, (view.at(other.position) - view.at(contacts[i].position)).norm() /
                                    (view.scale * picture.size));
      score += 0.5 * nearest / count;
    }
    if (score <= best_score) continue;
    best_score = score;
    best = azimuth;
  }
  return best;
}

/// The convex hull of points in the picture.
std::vector<Vector<2>> hull(std::vector<Vector<2>> points) {
  std::sort(points.begin(), points.end(), [](const Vector<2>& a, const Vector<2>& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  std::vector<Vector<2>> result;
  for (int half = 0; half < 2; ++half) {
    const std::size_t first = result.size();
    for (const Vector<2>& point : points) {
      while (result.size() >= first + 2) {
        const Vector<2> a = result.back() - result[result.size() - 2], b = point - result.back();
        if (a.x() * b.y() - a.y() * b.x() > 0) break;
        result.pop_back();
      }
      result.push_back(point);
    }
    result.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return result;
}

/// A circle about an axis, in the picture.
std::vector<Vector<2>> circle(const View& view, const Vector<3>& centre, const Vector<3>& axis,
                              double radius) {
  const Eigen::Matrix<double, 3, 2> t = tangents(axis);
  std::vector<Vector<2>> points;
  for (int k = 0; k <= 48; ++k) {
    const double angle = 2 * pi * k / 48;
    points.push_back(
        view.at(centre + radius * (std::cos(angle) * t.col(0) + std::sin(angle) * t.col(1))));
  }
  return points;
}

/// The cone that an arrow's tail may lie in: outside the object, where it can be seen.
void draw_cone(Canvas& canvas, const View& view, const Picture& picture,
               const Contact<3>& contact) {
  const double angle = std::atan(contact.friction), length = picture.cone_length;
  const Vector<3> base = contact.position - length * std::cos(angle) * contact.normal;
  std::vector<Vector<2>> rim = circle(view, base, contact.normal, length * std::sin(angle));
  canvas.line(rim, Colour(cone_colour), 1.2);
  rim.push_back(view.at(contact.position));
  const std::vector<Vector<2>> outline = hull(std::move(rim));
  canvas.fill(outline, Colour(cone_colour, 0.5));
  std::vector<Vector<2>> closed = outline;
  closed.push_back(outline.front());
  canvas.line(closed, Colour(cone_colour), 0.8);
}

/// A pad as far as its pressure can move, a point as a disc.
void draw_finger(Canvas& canvas, const View& view, const Picture& picture,
                 const Contact<3>& contact) {
  if (!contact.pad || contact.pad->reach.isZero(0)) {
    canvas.fill(circle(view, contact.position, contact.normal, 0.12 * picture.cone_length),
                Colour(line_colour));
    return;
  }
  const Pad& pad = *contact.pad;
  Vector<3> middle = contact.position;
  for (std::size_t k = 0; k < pad.points.size(); ++k) middle += pad.shares[k] * pad.points[k];
  const Vector<3> along = pad.reach.x() * pad.axis,
                  across = pad.reach.y() * contact.normal.cross(pad.axis);
  std::vector<Vector<2>> outline;
  for (const auto& [a, b] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}, {1, 1}})
    outline.push_back(view.at(middle + a * along + b * across));
  canvas.fill(outline, Colour(line_colour, 0.6));
  canvas.line(outline, Colour(line_colour), 2);
}

Colour push_colour(const Push& push) { return push.limited ? limit_colour : force_colour; }

/// Words beside something, in lines.
struct Label {
  std::vector<std::pair<std::string, const char*>> lines;  ///< with their colours
  Vector<2> anchor, away;                                  ///< where it belongs, and off what
};

using Rectangle = Eigen::AlignedBox2d;

/// How much of a line lies in a rectangle, roughly.
double covered(const Rectangle& box, const std::pair<Vector<2>, Vector<2>>& line) {
  double inside = 0;
  constexpr int steps = 24;
  for (int k = 0; k <= steps; ++k)
    inside += box.contains(Vector<2>(line.first + (line.second - line.first) * k / steps)) ? 1 : 0;
  return inside / steps * (line.second - line.first).norm();
}

/// Puts labels where they hide neither each other nor arrows.
void draw_labels(Canvas& canvas, const std::vector<Label>& labels,
                 const std::vector<std::pair<Vector<2>, Vector<2>>>& lines) {
  constexpr double letter = 15, row = 19;
  const Rectangle page(Vector<2>(6, top - 14),
                       Vector<2>(page_width - 6, page_height - bottom + 14));
  std::vector<Rectangle> taken;
  for (const Label& label : labels) {
    Vector<2> size(0, row * static_cast<double>(label.lines.size()));
    for (const auto& [words, colour] : label.lines)
      size.x() = std::max(size.x(), canvas.text_width(words, letter));
    Rectangle best;
    double best_cost = 1e300;
    for (const double distance : {8.0, 22.0, 40.0, 65.0, 95.0})
      for (int k = 0; k < 24; ++k) {
        const Vector<2> way(std::cos(2 * pi * k / 24), std::sin(2 * pi * k / 24));
        // Of a box that only just does not cover the anchor.
        const Vector<2> centre = label.anchor + distance * way + way.cwiseProduct(size) / 2;
        const Rectangle box(centre - size / 2, centre + size / 2);
        double cost = 0.6 * distance - 14 * way.dot(label.away);
        if (!page.contains(box)) cost += 1e4;
        for (const Rectangle& other : taken)
          if (box.intersects(other)) cost += 1e3 + box.intersection(other).volume();
        for (const auto& line : lines) cost += 4 * covered(box, line);
        if (cost >= best_cost) continue;
        best_cost = cost;
        best = box;
      }
    taken.emplace_back(best.min() - Vector<2>(3, 1), best.max() + Vector<2>(3, 1));
    const Vector<2> nearest = label.anchor.cwiseMax(best.min()).cwiseMin(best.max());
    if ((nearest - label.anchor).norm() > 30)
      canvas.line({label.anchor, nearest}, Colour(line_colour), 0.7);
    canvas.fill({best.corner(Rectangle::BottomLeft), best.corner(Rectangle::BottomRight),
                 best.corner(Rectangle::TopRight), best.corner(Rectangle::TopLeft)},
                Colour("#ffffff", 0.7));
    for (std::size_t k = 0; k < label.lines.size(); ++k)
      canvas.text(label.lines[k].first,
                  {best.min().x(), best.min().y() + row * (static_cast<double>(k) + 0.78)}, letter,
                  Colour(label.lines[k].second));
  }
}

/// The names of fingers and how hard they press, where their arrows begin.
std::vector<Label> finger_labels(const Picture& picture, const View& view) {
  const auto& contacts = picture.grasp.contacts();
  const auto fingers = picture.hold.holdable
                           ? finger_forces(picture.grasp, picture.hold)
                           : std::vector<FingerForce<3>>(picture.grasp.fingers().size());
  std::vector<Label> labels;
  if (fingers.size() > 16) return labels;  // no room
  for (std::size_t k = 0; k < fingers.size(); ++k) {
    Vector<3> place = Vector<3>::Zero(), outward = Vector<3>::Zero();
    double count = 0, moment = 0;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      if (picture.grasp.finger_of(i) != k) continue;
      Vector<3> tail = contacts[i].position - 0.3 * picture.cone_length * contacts[i].normal;
      for (const Push& push : picture.pushes)
        if (push.contact == i) tail = push.tail;
      place += tail;
      outward -= contacts[i].normal;
      if (picture.hold.holdable) moment += picture.hold.forces[i].torsion_moment;
      ++count;
    }
    const Vector<2> anchor = view.at(place / count);
    Vector<2> away = view.at(place / count + 0.1 * picture.size * outward) - anchor;
    if (away.norm() > 0) away.normalize();
    Label label{{{picture.grasp.fingers()[k], "#000000"}}, anchor, away};
    const double force = fingers[k].force.norm(), weight = picture.grasp.size();
    if (picture.hold.holdable)
      label.lines.emplace_back(newtons(force > 1e-9 * weight ? force : 0), force_colour);
    if (std::abs(moment) > 1e-6 * weight * picture.grasp.radius())
      label.lines.emplace_back(plain(std::abs(moment)) + " N m", force_colour);
    labels.push_back(std::move(label));
  }
  return labels;
}

/// The axes of the object's frame, in a corner.
void draw_axes(Canvas& canvas, const View& view) {
  const Vector<2> corner(62, page_height - 62);
  for (int k = 0; k < 3; ++k) {
    const Vector<3> axis = Vector<3>::Unit(k);
    const Vector<2> way(axis.dot(view.right), -axis.dot(view.upwards));
    canvas.arrow(corner, corner + 34 * way, Colour(line_colour), 1.6);
    canvas.text(std::string(1, "xyz"[k]), corner + 44 * way + Vector<2>(-4, 4), 13,
                Colour(line_colour));
  }
}

void draw_legend(Canvas& canvas, const Picture& picture) {
  double x = page_width - 20;
  const double y = page_height - 22;
  const auto any = [&](bool Push::*property) {
    return std::any_of(picture.pushes.begin(), picture.pushes.end(),
                       [&](const Push& push) { return push.*property; });
  };
  const auto entry = [&](const std::string& words, const Colour& colour, bool arrow,
                         const std::vector<double>& dashes) {
    x -= canvas.text_width(words, 13);
    canvas.text(words, {x, y + 4}, 13, Colour("#000000"));
    x -= 8;
    if (arrow)
      canvas.arrow({x - 28, y}, {x, y}, colour, 2.5, dashes);
    else
      canvas.fill({{x - 24, y - 6}, {x, y - 6}, {x, y + 6}, {x - 24, y + 6}}, colour);
    x -= 46;
  };
  entry("friction cone", Colour(cone_colour, 0.8), false, {});
  if (picture.other.is_there()) entry(other_load_title, weight_colour, true, {4, 3});
  if (picture.load.weight > 0) entry("weight", weight_colour, true, {});
  if (any(&Push::limited)) entry("at its force limit", limit_colour, true, {});
  if (any(&Push::hidden)) entry("from behind", force_colour, true, {4, 3});
  const bool pads = any(&Push::by_pad);
  if (!picture.pushes.empty())
    entry(pads ? "finger force, at a pad's centre of pressure" : "finger force", force_colour, true,
          {});
}

/// All that is drawn, in the middle and as large as there is room for.
void fit(View& view, const Picture& picture) {
  Rectangle all;
  const auto include = [&](const Vector<3>& point) {
    all.extend(Vector<2>(point.dot(view.right), point.dot(view.upwards)));
  };
  for (const Vector<3>& vertex : picture.mesh.vertices) include(vertex);
  for (const Contact<3>& contact : picture.grasp.contacts())
    include(contact.position - picture.cone_length * contact.normal);
  for (const Push& push : picture.pushes) include(push.tail);
  include(picture.load.com);
  include(picture.weight);
  for (const Vector<3>& point : picture.other_arrow) include(point);
  const Vector<2> centre = all.center(),
                  room(page_width - 2 * side, page_height - top - bottom - 40);
  view.centre = centre.x() * view.right + centre.y() * view.upwards;
  view.scale = std::min(room.x() / all.sizes().x(), room.y() / all.sizes().y());
}

ShadedBody body_in(const View& view, const Picture& picture) {
  View fine = view;
  fine.scale *= per_point;
  fine.middle *= per_point;
  return {picture.mesh, fine, static_cast<int>(per_point * page_width),
          static_cast<int>(per_point * page_height)};
}

/// The object between the contacts behind it and those before it, and the vertical through its com.
void draw_held_object(Canvas& canvas, const View& view, const Picture& picture,
                      const ShadedBody& body) {
  std::vector<Contact<3>> contacts = picture.grasp.contacts();  // from behind to the front
  std::sort(contacts.begin(), contacts.end(), [&](const Contact<3>& a, const Contact<3>& b) {
    return view.nearness(a.position) < view.nearness(b.position);
  });
  const auto averted = [&](const Contact<3>& contact) {
    return contact.normal.dot(view.toward) > 0;
  };
  const auto draw = [&](const Contact<3>& contact) {
    draw_finger(canvas, view, picture, contact);
    draw_cone(canvas, view, picture, contact);
  };
  for (const Contact<3>& contact : contacts)
    if (averted(contact)) draw(contact);
  canvas.image(body.shaded(0.86), body.width() / 2, body.height() / 2);
  const Vector<2> com = view.at(picture.load.com);
  canvas.line({{com.x(), top}, {com.x(), page_height - bottom}}, Colour(line_colour), 1.2, {2, 4});
  for (const Contact<3>& contact : contacts)
    if (!averted(contact)) draw(contact);
  // Nothing else shows what the contacts are contacts of.
  if (picture.mesh.triangles.empty() && contacts.size() <= 16)
    for (const Contact<3>& contact : contacts)
      canvas.line({com, view.at(contact.position)}, Colour(line_colour), 0.8, {5, 3});
}

/// Arrows of forces and the weight, with labels that hide none of them.
void draw_forces(Canvas& canvas, const View& view, const Picture& picture) {
  const double arrow = picture.grasp.contacts().size() > 8 ? 2 : 3.2;
  const Vector<2> com = view.at(picture.load.com);
  const bool is_heavy = picture.load.weight > 0;
  std::vector<std::pair<Vector<2>, Vector<2>>> lines;
  if (is_heavy) lines.emplace_back(com, view.at(picture.weight));
  for (const Push& push : picture.pushes) {
    const Vector<2> from = view.at(push.tail), to = view.at(push.head);
    canvas.arrow(from, to, push_colour(push), push.hidden ? 0.8 * arrow : arrow,
                 push.hidden ? std::vector<double>{5, 3} : std::vector<double>{});
    lines.emplace_back(from, to);
    if (push.by_pad) canvas.dot(to, 4, push_colour(push));
  }
  if (is_heavy) canvas.arrow(com, view.at(picture.weight), Colour(weight_colour), 3.2);
  canvas.dot(com, 5, Colour(weight_colour));
  std::vector<Label> labels = finger_labels(picture, view);
  if (!picture.other_arrow.empty()) {
    std::vector<Vector<2>> points;
    for (const Vector<3>& point : picture.other_arrow) points.push_back(view.at(point));
    for (std::size_t k = 1; k < points.size(); ++k) lines.emplace_back(points[k - 1], points[k]);
    canvas.arrow(points, Colour(weight_colour), 3.2, {5, 3});
    const Vector<2> tip = points.back(), from = points[points.size() - 2];
    Label label{{}, tip, Vector<2>::Zero()};
    for (const std::string& words : picture.other.words())
      label.lines.emplace_back(words, weight_colour);
    if (tip != from) label.away = (tip - from).normalized();
    labels.push_back(std::move(label));
  }
  if (is_heavy)
    labels.push_back({{{newtons(picture.load.weight), weight_colour}},
                      view.at(picture.weight),
                      Vector<2>(0, 1)});
  draw_labels(canvas, labels, lines);
}

}  // namespace

void draw_posture(const SpatialFile& file, const Grasp<3>& grasp, const Posture<3>& posture,
                  const std::string& words, const std::string& path) {
  Picture picture = picture_of(file, grasp, posture);
  const Eigen::Quaterniond orientation = orientation_of(posture.up);
  View view = view_from(best_azimuth(picture, orientation), orientation);
  fit(view, picture);
  const ShadedBody body = body_in(view, picture);
  for (Push& push : picture.pushes)
    push.hidden = hidden(picture, body, grasp.contacts()[push.contact]);

  Canvas canvas(page_width, page_height, has_ending(path, ".svg"));
  draw_held_object(canvas, view, picture, body);
  draw_forces(canvas, view, picture);
  const auto centred = [&](const std::string& line, double y, double size, bool bold) {
    canvas.text(line, {(page_width - canvas.text_width(line, size, bold)) / 2, y}, size,
                Colour("#000000"), bold);
  };
  centred(file.name.empty() ? "held object" : file.name, 34, 21, true);
  centred(words, 62, 16, false);
  draw_axes(canvas, view);
  draw_legend(canvas, picture);
  write_file(canvas.finish(), path);
}

}  // namespace poise
