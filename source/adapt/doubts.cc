// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/adapt/doubts.h"

#include "tetradapt/compare/deformation.h"
#include "tetradapt/mesh/thin_parts.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tetradapt::adapt
{
  namespace
  {
    using compare::Deformation;

    /** Part of the volume that strains and rotations must be too large in. */
    constexpr double enough_volume = 1e-3;

    /** Thin parts matter from this part of the strain on, ... */
    constexpr double enough_strain = 0.1;
    /** ... and bend or twist from this Bending::slenderness on. */
    constexpr double slender = 3.;

    /** Two digits, or all before the point. */
    std::string
    number(const double value)
    {
      std::ostringstream text;
      text.precision(2);
      if (value < 10.)
        text << value;
      else
        text << std::llround(std::min(value, 1e15));
      return text.str();
    }

    std::string
    percent(const double part)
    {
      return number(100. * part) + " %";
    }

    Doubt
    doubt_of_linearity(const Deformation &deformation)
    {
      std::string text;
      const auto  add
        = [&text](const std::string &what) { text += (text.empty() ? "" : "; ") + what; };
      if (deformation.displacement > Deformation::limit)
        add("displacements differ by " + percent(deformation.displacement) + " of the body's size");
      if (deformation.strain > Deformation::limit && deformation.strained_part > enough_volume)
        add("strains reach " + percent(deformation.strain) + ", and are above "
            + percent(Deformation::limit) + " in " + percent(deformation.strained_part)
            + " of the volume");
      if (deformation.rotation > Deformation::limit && deformation.rotated_part > enough_volume)
        add("rotations reach " + number(deformation.rotation * 180. / dealii::numbers::PI)
            + " degrees");
      if (text.empty())
        return {};
      Doubt doubt{"linear theory is doubtful: " + text + ".",
                  "It holds for small displacements, strains and rotations only, and error "
                  "estimates do not include what it neglects."};
      if (deformation.displacement > 1.)
        doubt.advice += " Look at the units of loads, lengths and Young moduli: N, mm and MPa go "
                        "together, and N, m and Pa.";
      return doubt;
    }

    Doubt
    doubt_of_thickness(const fem::Field &displacement)
    {
      const std::vector<bool> thin = mesh::thin_parts(displacement.mesh());
      if (std::find(thin.begin(), thin.end(), true) == thin.end())
        return {};
      const compare::Bending bending = compare::bending(displacement, thin);
      if (bending.strain < enough_strain || bending.slenderness < slender)
        return {};
      return {"linear elements lock: " + percent(bending.volume)
                + " of the body is fewer than four elements thick and bends or twists.",
              "Linear tetrahedra are too stiff there, and error estimates are too small. Set "
              "Degree = 2, or make the mesh finer there."};
    }
  } // namespace

  std::vector<Doubt>
  doubts_about(const fem::Field &displacement, const scene::Scene &scene)
  {
    std::vector<Doubt> doubts;
    const auto         add = [&doubts](const Doubt &doubt) {
      if (!doubt.what.empty())
        doubts.push_back(doubt);
    };
    if (scene.formulation != scene::Formulation::finite_strain)
      add(doubt_of_linearity(compare::deformation(displacement)));
    if (displacement.degree() == 1)
      add(doubt_of_thickness(displacement));
    return doubts;
  }
} // namespace tetradapt::adapt
