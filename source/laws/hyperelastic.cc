// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/laws/hyperelastic.h"

#include <cmath>

namespace tetradapt::laws
{
  namespace
  {
    /** The Voigt place of the pair (i, j). */
    constexpr unsigned int voigt[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};

    const Tensor<2, 3> I(dealii::unit_symmetric_tensor<3>());

    /** A_iJkL = delta_ik S_JL + F_iM CC_MJNL F_kN */
    void
    push_tangent(const Tensor<2, 3>          &F,
                 const SymmetricTensor<2, 3> &S,
                 const SymmetricTensor<4, 3> &CC,
                 Tangent                     &tangent)
    {
      // CC as a matrix, and B(v, 3 i + J) = F_iM where v is the pair (M, J): A = B^T CC B.
      double D[6][6], B[6][9] = {};
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = i; j < 3; ++j)
          for (unsigned int k = 0; k < 3; ++k)
            for (unsigned int l = k; l < 3; ++l)
              D[voigt[i][j]][voigt[k][l]] = CC[i][j][k][l];
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int J = 0; J < 3; ++J)
          for (unsigned int M = 0; M < 3; ++M)
            B[voigt[M][J]][3 * i + J] += F[i][M];
      double DB[6][9];
      for (unsigned int v = 0; v < 6; ++v)
        for (unsigned int a = 0; a < 9; ++a)
          {
            DB[v][a] = 0.;
            for (unsigned int w = 0; w < 6; ++w)
              DB[v][a] += D[v][w] * B[w][a];
          }
      unsigned int place = 0;
      for (unsigned int a = 0; a < 9; ++a)
        for (unsigned int b = a; b < 9; ++b, ++place)
          {
            double sum = a / 3 == b / 3 ? S[a % 3][b % 3] : 0.;
            for (unsigned int v = 0; v < 6; ++v)
              sum += B[v][a] * DB[v][b];
            tangent[place] = sum;
          }
    }
  } // namespace

  double
  above_logarithm(const double x)
  {
    if (std::abs(x) > 0.01)
      return x - std::log1p(x);
    // x^2/2 - x^3/3 + ..., to rounding.
    double sum = 0.;
    for (int k = 9; k >= 2; --k)
      sum = 1. / k - x * sum;
    return x * x * sum;
  }

  SymmetricTensor<4, 3>
  inverse_derivative(const SymmetricTensor<2, 3> &inverse_C)
  {
    SymmetricTensor<4, 3> result;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = i; j < 3; ++j)
        for (unsigned int k = 0; k < 3; ++k)
          for (unsigned int l = k; l < 3; ++l)
            result[i][j][k][l]
              = 0.5 * (inverse_C[i][k] * inverse_C[j][l] + inverse_C[i][l] * inverse_C[j][k]);
    return result;
  }

  bool
  Hyperelastic::supports(const Formulation formulation) const
  {
    return formulation == Formulation::finite_strain;
  }

  bool
  Hyperelastic::update(const Tensor<2, 3> &G,
                       const History,
                       const bool with_tangent,
                       Response  &response) const
  {
    const Tensor<2, 3> F = I + G;
    if (const double J = determinant(F); !(J > 0.) || !std::isfinite(J))
      return false;
    // det(I + G) = 1 + tr G + (tr^2 G - tr G^2)/2 + det G
    const double second = 0.5 * (trace(G) * trace(G) - scalar_product(G, transpose(G)));
    const double third  = determinant(G);
    Strain       strain;
    strain.twice_E   = 2. * symmetrize(G) + symmetrize(transpose(G) * G);
    strain.J_minus_1 = trace(G) + second + third;
    strain.J         = 1. + strain.J_minus_1;
    strain.shape     = scalar_product(G, G) - 2. * (second + third);
    if (!(strain.J > 0.))
      return false;
    strain.inverse_C           = invert(strain.twice_E + dealii::unit_symmetric_tensor<3>());
    const MaterialResponse own = evaluate(strain, with_tangent);
    response.energy            = own.energy;
    response.stress            = F * Tensor<2, 3>(own.stress);
    if (with_tangent)
      push_tangent(F, own.stress, own.tangent, response.tangent);
    bool is_finite = std::isfinite(response.energy) && std::isfinite(response.stress.norm());
    for (unsigned int k = 0; with_tangent && k < response.tangent.size(); ++k)
      is_finite = is_finite && std::isfinite(response.tangent[k]);
    return is_finite;
  }

  SymmetricTensor<2, 3>
  Hyperelastic::cauchy_stress(const Tensor<2, 3> &G, const Response &response) const
  {
    const Tensor<2, 3> F = I + G;
    return symmetrize(response.stress * transpose(F)) / determinant(F);
  }

  SymmetricTensor<4, 3>
  Hyperelastic::tangent_at_rest() const
  {
    Strain rest;
    rest.inverse_C = dealii::unit_symmetric_tensor<3>();
    return evaluate(rest, true).tangent;
  }
} // namespace tetradapt::laws
