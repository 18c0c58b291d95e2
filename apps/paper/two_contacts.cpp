#include "apps/paper/two_contacts.hpp"

#include <Eigen/LU>

namespace poise::study {

double effort_without_friction(const Grasp<2>& grasp, double theta) {
  const auto G = poise::grasp_matrix(grasp);
  const Wrench<2> w = grasp.loads().front().at(up_at(theta));
  const Eigen::Matrix3d GGt = G * G.transpose();
  return w.dot(GGt.inverse() * w);
}

double best_without_friction(const Grasp<2>& grasp) {
  const auto& contacts = grasp.contacts();
  return angle_of((contacts[0].position + contacts[1].position) / 2 - grasp.center());
}

std::vector<BothSlip> both_slip(const Grasp<2>& grasp) {
  const Contact<2>&one = grasp.contacts()[0], &two = grasp.contacts()[1];
  const Vector<2> com = grasp.center();
  const auto edge = [](const Contact<2>& contact, double side) -> Vector<2> {
    const Vector<2>& n = contact.normal;
    return n + side * contact.friction * Vector<2>(-n.y(), n.x());
  };
  std::vector<BothSlip> result;
  for (const double side1 : {-1.0, 1.0})
    for (const double side2 : {-1.0, 1.0}) {
      Eigen::Matrix2d edges, lines;
      edges << edge(one, side1), edge(two, side2);
      lines << edges.col(0), -edges.col(1);
      if (std::abs(lines.determinant()) < 1e-12) continue;
      const Vector<2> meet =
          one.position + (lines.inverse() * (two.position - one.position)).x() * edges.col(0);
      for (const double sign : {-1.0, 1.0}) {  // the meeting point above or below
        const Vector<2> up = sign * (meet - com).normalized();
        const Vector<2> normal = edges.inverse() * (grasp.size() * up);
        if (!(normal.minCoeff() > 0)) continue;
        result.push_back({.theta = angle_of(up),
                          .meet = meet,
                          .effort = (normal.x() * edges.col(0)).squaredNorm() +
                                    (normal.y() * edges.col(1)).squaredNorm()});
      }
    }
  return result;
}

}  // namespace poise::study
