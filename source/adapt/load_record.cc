// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/adapt/load_record.h"

#include "tetradapt/core/expression.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tetradapt::adapt
{
  namespace
  {
    /** Of a load's magnitude: changes below are quadrature's, remainders above are warned of. */
    constexpr double noticeable_change = 1e-6, doubtful_remainder = 1e-3;

    double
    relative(const double value, const double scale)
    {
      return scale > 0. ? value / scale : 0.;
    }

    std::string
    percent(const double part)
    {
      std::ostringstream text;
      text.precision(2);
      text << 100. * part << " %";
      return text.str();
    }

    /** Relative change of a load: of its force, its moment over @p lever and int |density|. */
    double
    change(const mechanics::LoadTotal &before,
           const mechanics::LoadTotal &after,
           const double                lever)
    {
      // Nodal forces have no density: their magnitude is that of their sum.
      const double scale   = std::max({before.magnitude,
                                       after.magnitude,
                                       before.resultant.force.norm(),
                                       after.resultant.force.norm()});
      double       largest = std::max((after.resultant.force - before.resultant.force).norm(),
                                std::abs(after.magnitude - before.magnitude));
      if (lever > 0.)
        largest
          = std::max(largest, (after.resultant.moment - before.resultant.moment).norm() / lever);
      return relative(largest, scale);
    }

    /** Of the body; the same on every rank. */
    double
    volume_of(const CycleRecord &record)
    {
      double sum = 0.;
      for (const auto &region : record.regions)
        sum += region.volume;
      return sum;
    }
  } // namespace

  void
  describe_loads(const scene::Scene                      &scene,
                 const std::vector<mechanics::LoadTotal> &totals,
                 const std::vector<LoadRecord>           &first,
                 CycleRecord                             &record)
  {
    record.loads.clear();
    for (std::size_t i = 0; i < totals.size(); ++i)
      {
        LoadRecord load;
        load.name  = scene.loads[i].name;
        load.total = totals[i];
        if (i < first.size())
          load.drift = change(first[i].total, totals[i], 0.);
        record.loads.push_back(load);
      }
  }

  std::string
  accuracy_of(const LoadRecord &load)
  {
    std::string  text;
    const double remainder = relative(load.total.remainder, load.total.magnitude);
    if (remainder > noticeable_change)
      text = "integrated to about " + percent(remainder);
    if (load.drift > noticeable_change)
      text += (text.empty() ? "" : ", ") + std::string("changed by ") + percent(load.drift)
              + " since the first mesh";
    return text;
  }

  std::vector<std::string>
  load_lines(const CycleRecord &record)
  {
    std::vector<std::string> lines;
    for (const LoadRecord &load : record.loads)
      {
        const std::string text = accuracy_of(load);
        if (!text.empty())
          lines.push_back("Cycle " + std::to_string(record.cycle) + ": Loads/" + load.name + " is "
                          + text + ".");
        for (const std::string *remark : {&load.total.remark, &load.total.note})
          if (!remark->empty())
            lines.push_back(*remark);
      }
    return lines;
  }

  std::vector<Doubt>
  doubts_about_loads(const CycleRecord &record)
  {
    std::vector<Doubt> doubts;
    for (const LoadRecord &load : record.loads)
      {
        const double part = relative(load.total.remainder, load.total.magnitude);
        if (part > doubtful_remainder)
          doubts.push_back({"Loads/" + load.name + " is integrated to " + percent(part) + " only.",
                            "Its value jumps, or has peaks or waves that are too small for this "
                            "mesh. A finer mesh there helps, and for a jump on a face Where in "
                            "place of if()."});
        if (!load.total.remark.empty())
          doubts.push_back({load.total.remark, "Features smaller than that may be missed."});
        if (!load.total.note.empty())
          doubts.push_back({load.total.note,
                            "If the pin presses on other faces too, select them; if it acts along "
                            "another direction, give that in Value."});
      }
    return doubts;
  }

  double
  change_of_problem(const CycleRecord &before, const CycleRecord &after)
  {
    const double volume = volume_of(before);
    // About the centre of the box, moments are at most this times the forces.
    const double lever   = before.equilibrium ? before.equilibrium->lever : 0.;
    double       largest = relative(std::abs(volume_of(after) - volume), volume);
    for (std::size_t i = 0; i < std::min(before.loads.size(), after.loads.size()); ++i)
      largest = std::max(largest, change(before.loads[i].total, after.loads[i].total, lever));
    return largest;
  }

  bool
  bound_is_guaranteed(const scene::Scene &scene, const CycleRecord &record)
  {
    for (const LoadRecord &load : record.loads)
      if (!load.total.is_converged() || !load.total.remark.empty())
        return false;
    for (const auto &support : scene.supports)
      {
        const std::string path = "Supports/" + support.name;
        if (!core::VectorExpression(support.displacement, path + "/Displacement").is_constant())
          return false;
        // Tractions of springs along normals that vary are no polynomials either.
        if (support.type == scene::SupportType::spring
            && (!core::Expression(support.spring.stiffness, path + "/Stiffness").is_constant()
                || (support.spring.direction == scene::SpringDirection::normal
                    && scene.mesh.projection != scene::MeshParameters::Projection::none)))
          return false;
      }
    return true;
  }
} // namespace tetradapt::adapt
