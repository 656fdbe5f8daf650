// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/equilibrated_loads.h"

#include "tetradapt/core/surface_expression.h"
#include "tetradapt/estimate/equilibrated_projection.h"
#include "tetradapt/mesh/true_surface.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace tetradapt::estimate
{
  using dealii::Point;

  namespace
  {
    /** A traction or a pressure. */
    struct FaceForce
    {
      core::SurfaceExpression value;
      bool                    pressure;
    };

    /** The rule by which mechanics::nodal_forces() integrates over faces. */
    struct FaceRule
    {
      FaceRule()
      {
        const dealii::QGaussSimplex<2> rule(3);
        for (unsigned int q = 0; q < rule.size(); ++q)
          {
            const auto                 &p = rule.point(q);
            const std::array<double, 3> b{{1. - p[0] - p[1], p[0], p[1]}};
            points.push_back(b);
            weights.push_back(2. * rule.weight(q));
            functions.push_back(
              {{b[0], b[1], b[2], 4. * b[0] * b[1], 4. * b[1] * b[2], 4. * b[2] * b[0]}});
          }
        projection = least_squares(functions, weights);
      }
      std::vector<std::array<double, 3>> points;
      std::vector<double>                weights;
      std::vector<std::array<double, 6>> functions, projection;
    };

    void
    integrate(const FaceRule                       &rule,
              const mesh::TetMesh                  &mesh,
              const mesh::TrueSurface              &surface,
              const unsigned int                    f,
              const std::vector<const FaceForce *> &forces,
              FaceLoad                             &load)
    {
      const mesh::BoundaryFace   &face = mesh.faces[f];
      const Tensor<1, 3>          area = mesh::face_area_vector(mesh, face);
      const double                size = area.norm();
      std::vector<Tensor<1, 3>>   traction(rule.weights.size());
      std::array<Tensor<1, 3>, 6> polynomial;
      for (unsigned int q = 0; q < rule.weights.size(); ++q)
        {
          Point<3> x;
          for (unsigned int i = 0; i < 3; ++i)
            x += rule.points[q][i] * Tensor<1, 3>(mesh.points[face.vertices[i]]);
          for (const FaceForce *force : forces)
            {
              const Tensor<1, 3> normal
                = force->value.uses_normal() ? surface.at(f, x).normal : Tensor<1, 3>();
              const Tensor<1, 3> given = force->value(x, normal);
              traction[q] += force->pressure ? -given[0] / size * area : given;
            }
          for (unsigned int c = 0; c < 3; ++c)
            if ((load.held >> c & 1) != 0)
              traction[q][c] = 0.;
          for (unsigned int s = 0; s < 6; ++s)
            {
              load.moments[s] += size * rule.weights[q] * rule.functions[q][s] * traction[q];
              polynomial[s] += rule.projection[q][s] * traction[q];
            }
        }
      double square = 0., all = 0.;
      for (unsigned int q = 0; q < rule.weights.size(); ++q)
        {
          Tensor<1, 3> rest = traction[q];
          for (unsigned int s = 0; s < 6; ++s)
            rest -= rule.functions[q][s] * polynomial[s];
          square += rule.weights[q] * rest.norm_square();
          all += rule.weights[q] * traction[q].norm_square();
        }
      // Rounding is no oscillation.
      load.oscillation = square > 1e-26 * all ? std::sqrt(size * square) : 0.;
    }
  } // namespace

  std::vector<FaceLoad>
  face_loads(const scene::Scene &scene, const mesh::TetMesh &mesh)
  {
    std::map<std::string, unsigned char> supports;
    std::map<std::string, FaceForce>     tractions;
    for (const auto &support : scene.supports)
      for (unsigned int c = 0; c < 3; ++c)
        supports["Supports/" + support.name] |= support.components[c] ? 1u << c : 0u;
    for (const auto &load : scene.loads)
      if (load.type == scene::LoadType::traction || load.type == scene::LoadType::pressure)
        {
          const bool pressure = load.type == scene::LoadType::pressure;
          const auto texts
            = pressure ? std::array<std::string, 3>{{load.value[0], "0", "0"}} : load.value;
          tractions.emplace(
            "Loads/" + load.name,
            FaceForce{core::SurfaceExpression(texts, "Loads/" + load.name + "/Value"), pressure});
        }
    std::vector<unsigned char>                  held(mesh.patches.size(), 0);
    std::vector<std::vector<const FaceForce *>> forces(mesh.patches.size());
    for (unsigned int patch = 0; patch < mesh.patches.size(); ++patch)
      for (const auto &name : mesh.patches[patch].selections)
        {
          const auto support  = supports.find(name);
          const auto traction = tractions.find(name);
          if (support != supports.end())
            held[patch] |= support->second;
          if (traction != tractions.end())
            forces[patch].push_back(&traction->second);
        }
    const bool uses_normal = std::any_of(tractions.begin(), tractions.end(), [](const auto &entry) {
      return entry.second.value.uses_normal();
    });
    const mesh::TrueSurface surface(uses_normal ? scene.mesh : scene::MeshParameters(), mesh);
    const FaceRule          rule;
    std::vector<FaceLoad>   loads(mesh.faces.size());
    for (unsigned int f = 0; f < mesh.faces.size(); ++f)
      {
        const unsigned int patch = mesh.faces[f].patch;
        loads[f].held            = held[patch];
        if (!forces[patch].empty() && held[patch] != 7)
          integrate(rule, mesh, surface, f, forces[patch], loads[f]);
      }
    return loads;
  }

} // namespace tetradapt::estimate
