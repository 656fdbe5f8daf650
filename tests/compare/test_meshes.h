// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_tests_compare_test_meshes_h
#define tetradapt_tests_compare_test_meshes_h

#include "tetradapt/mesh/nodal_field.h"

#include <cstdint>
#include <functional>
#include <memory>

namespace test_meshes
{
  using dealii::Point;
  using dealii::Tensor;
  using namespace tetradapt;

  /** The same numbers in [0,1) on every machine (a linear congruential generator). */
  class Random
  {
  public:
    explicit Random(const std::uint64_t seed) : state(seed)
    {
    }
    double
    operator()()
    {
      state = state * 6364136223846793005ULL + 1442695040888963407ULL;
      return double(state >> 11) / 9007199254740992.;
    }

  private:
    std::uint64_t state;
  };

  /** The unit cube cut into n^3 bricks of six tetrahedra each, its points moved
   * by @p map. Region 1 where the brick's centre (before) has x > 0.5, else 0. */
  inline std::shared_ptr<mesh::TetMesh>
  cube(const unsigned int n, const std::function<Point<3>(const Point<3> &)> &map)
  {
    auto       mesh  = std::make_shared<mesh::TetMesh>();
    const auto point = [n](unsigned int i, unsigned int j, unsigned int k) {
      return i + (n + 1) * (j + (n + 1) * k);
    };
    for (unsigned int k = 0; k <= n; ++k)
      for (unsigned int j = 0; j <= n; ++j)
        for (unsigned int i = 0; i <= n; ++i)
          mesh->points.push_back(map(Point<3>(double(i) / n, double(j) / n, double(k) / n)));
    // Kuhn's cut: one tetrahedron for every order of the three axes.
    const unsigned int orders[6][3]
      = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int o = 0; o < 6; ++o)
            {
              unsigned int                at[3] = {i, j, k};
              std::array<unsigned int, 4> cell;
              cell[0] = point(at[0], at[1], at[2]);
              for (unsigned int step = 0; step < 3; ++step)
                {
                  ++at[orders[o][step]];
                  cell[step + 1] = point(at[0], at[1], at[2]);
                }
              if (o >= 3)
                std::swap(cell[2], cell[3]);
              mesh->cells.push_back(cell);
              mesh->regions.push_back(2 * i + 1 > n ? 1 : 0);
            }
    return mesh;
  }

  /** Moves the cube's points at random by up to @p amount of a brick's edge,
   * those on the surface only along it; the corner at 1 stays. */
  inline std::function<Point<3>(const Point<3> &)>
  shaken(const unsigned int n, const double amount, const std::uint64_t seed)
  {
    auto random = std::make_shared<Random>(seed);
    return [=](const Point<3> &p) {
      Point<3> q = p;
      for (unsigned int d = 0; d < 3; ++d)
        {
          const double shift = amount / n * (2. * (*random)() - 1.);
          if (p[d] > 0. && p[d] < 1.)
            q[d] += shift;
        }
      return q;
    };
  }

  /** A field with the given values at its nodes. */
  inline std::shared_ptr<mesh::NodalField>
  interpolate(std::shared_ptr<const mesh::TetMesh>                 mesh,
              const unsigned int                                   degree,
              const std::function<Tensor<1, 3>(const Point<3> &)> &f)
  {
    auto field = std::make_shared<mesh::NodalField>(mesh, degree);
    for (unsigned int n = 0; n < field->n_nodes(); ++n)
      field->values[n] = f(field->node_position(n));
    return field;
  }
} // namespace test_meshes

#endif
