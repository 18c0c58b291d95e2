#include "poise/adhesion.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

namespace poise {
namespace {

template <int Dim>
Vector<Dim> middle_of(const Contact<Dim>& contact) {
  Vector<Dim> middle = contact.position;
  if constexpr (Dim == 3)
    if (contact.pad)
      for (std::size_t k = 0; k < contact.pad->points.size(); ++k)
        middle += contact.pad->shares[k] * contact.pad->points[k];
  return middle;
}

/// Whether nothing but the pulls closes the fingers.
template <int Dim>
bool is_vacuum(const std::vector<Contact<Dim>>& contacts, const Mechanism<Dim>& mechanism,
               const std::set<std::string>& pulled) {
  return mechanism.kind == DriveKind::each &&
         std::all_of(mechanism.fingers.begin(), mechanism.fingers.end(),
                     [](const Finger<Dim>& finger) { return !std::isfinite(finger.max_force); }) &&
         std::all_of(contacts.begin(), contacts.end(), [&](const Contact<Dim>& contact) {
           return pulled.contains(contact.finger);
         });
}

/// The closing directions that fingers have without their pulls are said.
template <int Dim>
void keep_closing(const std::vector<Contact<Dim>>& contacts, const std::set<std::string>& pulled,
                  Mechanism<Dim>& mechanism) {
  std::map<std::string, Vector<Dim>> sums;
  for (const Contact<Dim>& contact : contacts)
    if (pulled.contains(contact.finger))
      sums.try_emplace(contact.finger, Vector<Dim>::Zero()).first->second +=
          contact.share * contact.normal.stableNormalized();
  for (const auto& each : sums) {
    const std::string& name = each.first;
    const Vector<Dim>& sum = each.second;
    const auto known = std::find_if(mechanism.fingers.begin(), mechanism.fingers.end(),
                                    [&](const auto& finger) { return finger.name == name; });
    if (known == mechanism.fingers.end())
      mechanism.fingers.push_back({.name = name, .closing = sum});
    else if (known->closing.isZero(0))
      known->closing = sum;
  }
}

}  // namespace

template <int Dim>
void add_pulls(const std::vector<Pull<Dim>>& pulls, std::vector<Contact<Dim>>& contacts,
               Mechanism<Dim>& mechanism) {
  if (pulls.empty()) return;
  std::set<std::string> pulled;
  for (const Pull<Dim>& pull : pulls) {
    if (!(pull.force > 0) || !std::isfinite(pull.force * pull.force))
      throw InvalidGrasp("adhesion", "must be a force above 0");
    pulled.insert(pull.at.finger);
  }
  const bool vacuum = is_vacuum(contacts, mechanism, pulled);
  if (vacuum) mechanism = {.kind = DriveKind::listed, .fingers = mechanism.fingers};
  if (!vacuum) keep_closing(contacts, pulled, mechanism);
  std::map<std::string, int> count;
  for (const Pull<Dim>& pull : pulls) {
    Contact<Dim> contact;
    contact.position = middle_of(pull.at);
    contact.normal = -pull.at.normal;
    contact.finger = pull.at.finger;
    if (vacuum) {
      contact.finger += " vacuum";
      if (const int before = count[contact.finger]++; before > 0)
        contact.finger += " " + std::to_string(before + 1);
      Twist<Dim> along = Twist<Dim>::Zero();
      along.template head<Dim>() = contact.normal.stableNormalized();
      mechanism.drives.push_back({contact.finger, {{contact.finger, along}}, pull.force});
    } else {
      contact.min_normal = contact.max_normal = pull.force;
    }
    contacts.push_back(std::move(contact));
  }
}

template void add_pulls(const std::vector<Pull<2>>&, std::vector<Contact<2>>&, Mechanism<2>&);
template void add_pulls(const std::vector<Pull<3>>&, std::vector<Contact<3>>&, Mechanism<3>&);

}  // namespace poise
