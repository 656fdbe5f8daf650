// SPDX-License-Identifier: AGPL-3.0-or-later
#include "loads.h"

#include "tetradapt/mechanics/springs.h"
#include "tetradapt/mechanics/supports.h"
#include "tetradapt/mechanics/surface_loads.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/full_matrix.h>

#include <cmath>

namespace tetradapt::estimate
{
  namespace
  {
    /** l_0, l_1, l_2, 4 l_0 l_1, 4 l_1 l_2, 4 l_2 l_0 */
    std::array<double, 6>
    face_functions(const std::array<double, 3> &b)
    {
      return {{b[0], b[1], b[2], 4. * b[0] * b[1], 4. * b[1] * b[2], 4. * b[2] * b[0]}};
    }

    /** The polynomial of degree 2 with given means of products with the functions, as
     * coefficients of these. */
    std::array<Tensor<1, 3>, 6>
    polynomial_with(const std::array<Tensor<1, 3>, 6> &means)
    {
      static const dealii::FullMatrix<double> inverse = [] {
        dealii::FullMatrix<double>     products(6, 6);
        const dealii::QGaussSimplex<2> rule(3);
        for (unsigned int q = 0; q < rule.size(); ++q)
          {
            const auto &p = rule.point(q);
            const auto  f = face_functions({{1. - p[0] - p[1], p[0], p[1]}});
            for (unsigned int i = 0; i < 6; ++i)
              for (unsigned int j = 0; j < 6; ++j)
                products(i, j) += 2. * rule.weight(q) * f[i] * f[j];
          }
        products.gauss_jordan();
        return products;
      }();
      std::array<Tensor<1, 3>, 6> result;
      for (unsigned int i = 0; i < 6; ++i)
        for (unsigned int j = 0; j < 6; ++j)
          result[i] += inverse(i, j) * means[j];
      return result;
    }

    /** Adds a load on a face. Norms of what polynomials leave of several loads are added. */
    void
    integrate(const mechanics::SurfaceLoads::Samples &samples, const double size, FaceLoad &load)
    {
      std::array<Tensor<1, 3>, 6> means;
      std::vector<Tensor<1, 3>>   traction;
      for (const auto &point : samples)
        {
          traction.push_back(point.value);
          for (unsigned int c = 0; c < 3; ++c)
            if ((load.held >> c & 1) != 0)
              traction.back()[c] = 0.;
          const auto f = face_functions(point.b);
          for (unsigned int s = 0; s < 6; ++s)
            means[s] += point.weight * f[s] * traction.back();
        }
      if (samples.size() == 1) // a constant
        for (unsigned int s = 0; s < 6; ++s)
          means[s] = traction[0] / 3.;
      for (unsigned int s = 0; s < 6; ++s)
        load.moments[s] += size * means[s];
      if (samples.size() == 1)
        return;
      const auto polynomial = polynomial_with(means);
      double     square = 0., all = 0.;
      for (unsigned int q = 0; q < samples.size(); ++q)
        {
          const auto   f    = face_functions(samples[q].b);
          Tensor<1, 3> rest = traction[q];
          for (unsigned int s = 0; s < 6; ++s)
            rest -= f[s] * polynomial[s];
          square += samples[q].weight * rest.norm_square();
          all += samples[q].weight * traction[q].norm_square();
        }
      // Rounding is no oscillation.
      load.oscillation += square > 1e-26 * all ? std::sqrt(size * square) : 0.;
    }
    void
    add_springs(const scene::Scene     &scene,
                const mesh::NodalField &displacement,
                std::vector<FaceLoad>  &loads)
    {
      const mesh::TetMesh     &mesh = displacement.mesh();
      const mechanics::Springs springs(scene, mesh);
      if (springs.empty())
        return;
      const unsigned int n = displacement.degree() == 1 ? 3 : 6;
      const auto         nodes
        = mechanics::boundary_face_nodes(mesh, n == 3 ? nullptr : &displacement.edges());
      mechanics::SurfaceLoads::Samples samples;
      double                           N[6];
      for (const mechanics::Springs::Face &face : springs.faces())
        {
          const double area = mesh::face_area_vector(mesh, mesh.faces[face.face]).norm();
          samples.clear();
          for (const mechanics::Springs::Sample &point : face.points)
            {
              mechanics::face_shape_values(displacement.degree(), point.b, N);
              Tensor<1, 3> u;
              for (unsigned int i = 0; i < n; ++i)
                u += N[i] * displacement.values[nodes[face.face][i]];
              samples.push_back({point.b, point.weight / area, point.traction(u)});
            }
          integrate(samples, area, loads[face.face]);
        }
    }
  } // namespace

  std::vector<FaceLoad>
  face_loads(const scene::Scene &scene, const mesh::NodalField &displacement)
  {
    const mesh::TetMesh                 &mesh = displacement.mesh();
    std::map<std::string, unsigned char> supports;
    for (const auto &support : scene.supports)
      for (unsigned int c = 0; c < 3; ++c)
        supports["Supports/" + support.name] |= support.components[c] ? 1u << c : 0u;
    std::vector<unsigned char> held(mesh.patches.size(), 0);
    for (unsigned int patch = 0; patch < mesh.patches.size(); ++patch)
      for (const auto &name : mesh.patches[patch].selections)
        {
          const auto support = supports.find(name);
          if (support != supports.end())
            held[patch] |= support->second;
        }
    const mechanics::SurfaceLoads    given(scene, mesh);
    mechanics::SurfaceLoads::Samples samples;
    std::vector<FaceLoad>            loads(mesh.faces.size());
    for (unsigned int f = 0; f < mesh.faces.size(); ++f)
      {
        loads[f].held = held[mesh.faces[f].patch];
        if (loads[f].held == 7)
          continue;
        for (const unsigned int load : given.on_face(f))
          {
            given.sample_compactly(load, f, samples);
            integrate(samples, mesh::face_area_vector(mesh, mesh.faces[f]).norm(), loads[f]);
          }
      }
    add_springs(scene, displacement, loads);
    return loads;
  }
} // namespace tetradapt::estimate
