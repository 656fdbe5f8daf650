// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/tangent_field.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace tetradapt::mechanics
{
  namespace
  {
    constexpr std::array<std::array<unsigned int, 2>, 6> voigt{
      {{{0, 0}}, {{1, 1}}, {{2, 2}}, {{1, 2}}, {{0, 2}}, {{0, 1}}}};

    bool
    is_isotropic(const VoigtMatrix &D)
    {
      const double lambda = D[0][1], mu = D[3][3];
      const double scale = std::abs(D[0][0]) + std::abs(mu);
      double       worst = 0.;
      for (unsigned int i = 0; i < 6; ++i)
        for (unsigned int j = 0; j < 6; ++j)
          {
            const double normal   = i < 3 && j < 3 ? lambda : 0.;
            const double expected = normal + (i != j ? 0. : i < 3 ? 2. * mu : mu);
            worst                 = std::max(worst, std::abs(D[i][j] - expected));
          }
      return worst <= 1e-14 * scale;
    }
  } // namespace

  VoigtMatrix
  to_voigt(const SymmetricTensor<4, 3> &C)
  {
    VoigtMatrix D;
    for (unsigned int i = 0; i < 6; ++i)
      for (unsigned int j = 0; j < 6; ++j)
        D[i][j] = C[voigt[i][0]][voigt[i][1]][voigt[j][0]][voigt[j][1]];
    return D;
  }

  TangentField::TangentField(const MaterialMap &materials, const mesh::TetMesh &mesh)
    : which(mesh.n_cells()), n_points(1)
  {
    std::map<int, unsigned int> numbers;
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      {
        const int region           = mesh.regions[cell];
        const auto [entry, is_new] = numbers.emplace(region, matrices.size());
        if (is_new)
          matrices.push_back(to_voigt(materials.linear_law(region).tangent_at_rest()));
        which[cell] = entry->second;
      }
    isotropic = std::all_of(matrices.begin(), matrices.end(), mechanics::is_isotropic);
  }

  TangentField::TangentField(const std::vector<SymmetricTensor<4, 3>> &tensors,
                             std::vector<unsigned int>                 which,
                             unsigned int                              n_points)
    : which(std::move(which)), n_points(n_points)
  {
    for (const auto &tensor : tensors)
      matrices.push_back(to_voigt(tensor));
    isotropic
      = n_points == 1 && std::all_of(matrices.begin(), matrices.end(), mechanics::is_isotropic);
  }

  TangentField::TangentField(std::vector<laws::Tangent> tangents,
                             std::vector<unsigned int>  first,
                             const unsigned int         n_points)
    : full_tangents(std::move(tangents)), which(std::move(first)), n_points(n_points),
      isotropic(false)
  {
  }
} // namespace tetradapt::mechanics
