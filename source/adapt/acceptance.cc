// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/adapt/acceptance.h"

#include "tetradapt/core/expression.h"
#include "tetradapt/scene/singular_places.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::adapt
{
  namespace
  {
    constexpr double rounding      = 1e-10; ///< of Pi, relative
    constexpr double concentration = 3.;    ///< see compare_energies()
    constexpr double quadrature    = 1e-5;  ///< change of a load that quadrature may cause

    /** Whether a function is linear on all faces that carry a selection, as their corners
     * and their centroids tell. */
    bool
    is_linear(const core::Expression &function,
              const mesh::TetMesh    &mesh,
              const std::string      &selection)
    {
      if (function.is_constant())
        return true;
      double largest = 0., deviation = 0.;
      for (const mesh::BoundaryFace &face : mesh.faces)
        {
          const auto &names = mesh.patches[face.patch].selections;
          if (std::find(names.begin(), names.end(), selection) == names.end())
            continue;
          mesh::Point<3> middle;
          double         mean = 0.;
          for (const unsigned int v : face.vertices)
            {
              const double value = function(mesh.points[v]);
              largest            = std::max(largest, std::abs(value));
              mean += value / 3.;
              middle += mesh.points[v] / 3.;
            }
          deviation = std::max(deviation, std::abs(function(middle) - mean));
        }
      return deviation <= 1e-9 * largest;
    }

    /** Whether the faces that carry a selection make flat parts which meet at large angles only, as
     * those of a block do: nodes are held along the same normals on every mesh. */
    bool
    is_flat(const mesh::TetMesh &mesh, const std::string &selection)
    {
      std::vector<mesh::Tensor<1, 3>> normals;
      for (const mesh::BoundaryFace &face : mesh.faces)
        {
          const auto &names = mesh.patches[face.patch].selections;
          if (std::find(names.begin(), names.end(), selection) == names.end())
            continue;
          const auto area     = mesh::face_area_vector(mesh, face);
          const auto normal   = area / area.norm();
          const bool is_known = std::any_of(normals.begin(), normals.end(), [&](const auto &other) {
            return (normal - other).norm() < 1e-9;
          });
          if (is_known)
            continue;
          // Faces at small angles share a mean normal, which depends on the mesh.
          for (const auto &other : normals)
            if (normal * other > 0.5)
              return false;
          normals.push_back(normal);
        }
      return true;
    }
  } // namespace

  std::string
  why_energy_cannot_tell(const scene::Scene &scene, const mesh::TetMesh &mesh)
  {
    if (scene.formulation == scene::Formulation::mixed)
      return "a solution in mixed form does not minimise the energy";
    if (const std::string place = scene::first_singular_place(scene); !place.empty())
      return "the energy of " + place + " grows without limit as the mesh is refined";
    for (const auto &load : scene.loads)
      if (load.type == scene::LoadType::nodal_force)
        return "the forces at nodes of Loads/" + load.name + " grow with the mesh";
    for (const auto &support : scene.supports)
      if (support.type == scene::SupportType::sliding
          && (!is_flat(mesh, "Supports/" + support.name)
              || !is_linear(core::Expression(support.normal_displacement,
                                             "Supports/" + support.name + "/Normal displacement"),
                            mesh,
                            "Supports/" + support.name)))
        return "the nodes of Supports/" + support.name
               + " are held along normals that differ from mesh to mesh";
    for (const auto &support : scene.supports)
      for (unsigned int d = 0; d < 3; ++d)
        if (support.type == scene::SupportType::fixed && support.components[d]
            && !is_linear(core::Expression(support.displacement[d],
                                           "Supports/" + support.name + "/Displacement"),
                          mesh,
                          "Supports/" + support.name))
          return "the displacements of Supports/" + support.name
                 + " are not linear, so that they differ from mesh to mesh";
    return "";
  }

  bool
  is_same_problem(const double change, const double swept)
  {
    return change <= concentration * swept + quadrature;
  }

  EnergyTest
  compare_energies(const CycleEnergy &before,
                   const CycleEnergy &after,
                   const double       swept,
                   const double       change)
  {
    const double scale = std::max(std::abs(before.potential), std::abs(after.potential));
    EnergyTest   test;
    test.change    = after.potential - before.potential;
    test.allowance = (rounding + concentration * swept + 2. * change) * scale
                     + 0.5
                         * (before.algebraic_error * before.algebraic_error
                            + after.algebraic_error * after.algebraic_error);
    return test;
  }

  bool
  is_worse_estimate(const double before, const double after)
  {
    return after > 1.1 * before;
  }
} // namespace tetradapt::adapt
