// SPDX-License-Identifier: AGPL-3.0-or-later
#include "sweeps.h"

#include "tetradapt/core/clones.h"
#include "tetradapt/core/lanes.h"

#include <cmath>
#include <cstring>

namespace tetradapt::estimate
{
  namespace
  {
    using core::Lanes;
    using State    = TractionRelaxation::State;
    using FaceMove = TractionRelaxation::FaceMove;
    using RingMove = TractionRelaxation::RingMove;

    constexpr unsigned int n    = TractionRelaxation::n;
    constexpr unsigned int none = -1;

    /** In place, row by row; the diagonal is inverted. Where it is nought, compared
     * with what it was (a move that no energy resists, or none but others make), its
     * inverse becomes zero: the move is not made. */
    TETRADAPT_INLINE void
    cholesky(double *matrix, const unsigned int size)
    {
      for (unsigned int i = 0; i < size; ++i)
        {
          double      *row  = matrix + i * (i + 1) / 2;
          const double full = row[i];
          for (unsigned int j = 0; j <= i; ++j)
            {
              const double *other = matrix + j * (j + 1) / 2;
              double        sum   = row[j];
              for (unsigned int k = 0; k < j; ++k)
                sum -= row[k] * other[k];
              if (j < i)
                row[j] = sum * other[j];
              else
                row[i] = sum > 1e-6 * full && sum > 0. ? 1. / std::sqrt(sum) : 0.;
            }
        }
    }

    TETRADAPT_INLINE void
    solve(const double *matrix, const unsigned int size, double *x)
    {
      for (unsigned int i = 0; i < size; ++i)
        {
          const double *row = matrix + i * (i + 1) / 2;
          for (unsigned int k = 0; k < i; ++k)
            x[i] -= row[k] * x[k];
          x[i] *= row[i];
        }
      for (unsigned int i = size; i-- > 0;)
        {
          const double *row = matrix + i * (i + 1) / 2;
          x[i] *= row[i];
          for (unsigned int k = 0; k < i; ++k)
            x[k] -= row[k] * x[i];
        }
    }

    /** Components of a face's gradient along its moves: the tractions 4 l_s l_(s+1)
     * of the components that may change, then, if all may, a pull along each edge
     * at its ends. */
    TETRADAPT_INLINE void
    restrict_to(const FaceMove &move, const double *g, double *x)
    {
      unsigned int k = 0;
      for (unsigned int i = 9; i < 18; ++i)
        if ((move.components >> (i % 3) & 1) != 0)
          x[k++] = g[i];
      if (move.components == 7)
        for (unsigned int s = 0; s < 3; ++s, ++k)
          {
            const double *edge = move.edges + 3 * s;
            const double *from = g + 3 * s, *to = g + 3 * ((s + 1) % 3);
            x[k] = edge[0] * (from[0] - to[0]) + edge[1] * (from[1] - to[1])
                   + edge[2] * (from[2] - to[2]);
          }
    }

    TETRADAPT_INLINE void
    prolongate(const FaceMove &move, const double *x, double *change)
    {
      for (unsigned int i = 0; i < 18; ++i)
        change[i] = 0.;
      unsigned int k = 0;
      for (unsigned int i = 9; i < 18; ++i)
        if ((move.components >> (i % 3) & 1) != 0)
          change[i] = x[k++];
      if (move.components == 7)
        for (unsigned int s = 0; s < 3; ++s, ++k)
          for (unsigned int d = 0; d < 3; ++d)
            {
              change[3 * s + d] += x[k] * move.edges[3 * s + d];
              change[3 * ((s + 1) % 3) + d] -= x[k] * move.edges[3 * s + d];
            }
    }
  } // namespace

  void
  factorise(const State &state, FaceMove &move)
  {
    double matrix[18][18] = {}, half[18][12], column[18], full[12][12];
    for (const unsigned int at : move.cells)
      if (at != none)
        for (unsigned int i = 0; i < 18; ++i)
          for (unsigned int j = 0; j < 18; ++j)
            matrix[i][j] += state.flexibility[(std::size_t(n) * (at / 4) + 18 * (at % 4) + i) * n
                                              + 18 * (at % 4) + j];
    unsigned int size = move.components == 7 ? 12 : 0;
    if (size == 0)
      for (unsigned int c = 0; c < 3; ++c)
        size += (move.components >> c & 1) != 0 ? 3 : 0;
    move.size = size;
    for (unsigned int i = 0; i < 18; ++i)
      restrict_to(move, matrix[i], half[i]);
    for (unsigned int k = 0; k < size; ++k)
      {
        for (unsigned int i = 0; i < 18; ++i)
          column[i] = half[i][k];
        restrict_to(move, column, full[k]);
      }
    for (unsigned int k = 0; k < size; ++k)
      for (unsigned int l = 0; l <= k; ++l)
        move.factor[k * (k + 1) / 2 + l] = full[k][l];
    cholesky(move.factor, size);
  }

  void
  factorise(const State &state, RingMove &move)
  {
    for (double &value : move.factor)
      value = 0.;
    for (unsigned int t = move.begin; t < move.end; ++t)
      {
        const auto  &turn = state.turns[t];
        const float *H    = &state.flexibility[std::size_t(n) * n * turn.cell];
        for (unsigned int p = 0; p < 2; ++p)
          for (unsigned int q = 0; q < 2; ++q)
            for (unsigned int i = 0; i < move.size; ++i)
              for (unsigned int j = 0; j <= i; ++j)
                {
                  const unsigned int a = move.components[i], b = move.components[j];
                  move.factor[i * (i + 1) / 2 + j]
                    += turn.sign[p] * turn.sign[q]
                       * H[n * (turn.first[p] + turn.at[p][a / 3] + a % 3) + turn.first[q]
                           + turn.at[q][b / 3] + b % 3];
                }
      }
    cholesky(move.factor, move.size);
  }

  namespace
  {
    /** gradient += sum of change[i] times row rows[i] of the cell's matrix. */
    TETRADAPT_INLINE void
    update(double             *gradient,
           const float        *matrix,
           const unsigned int *rows,
           const double       *change,
           const unsigned int  size)
    {
      using Floats                   = float __attribute__((vector_size(32)));
      constexpr unsigned int n_lanes = n / 8;
      Lanes                  sum[n_lanes];
      std::memcpy(sum, gradient, sizeof(sum));
      for (unsigned int i = 0; i < size; ++i)
        {
          const float *row = matrix + n * rows[i];
          for (unsigned int k = 0; k < n_lanes; ++k)
            {
              Floats values;
              std::memcpy(&values, row + 8 * k, sizeof(values));
              sum[k] += change[i] * __builtin_convertvector(values, Lanes);
            }
        }
      std::memcpy(gradient, sum, sizeof(sum));
    }

    TETRADAPT_INLINE void
    make(State &state, const FaceMove &move)
    {
      double gradient[18] = {}, x[12], change[18];
      for (const unsigned int at : move.cells)
        if (at != none)
          for (unsigned int i = 0; i < 18; ++i)
            gradient[i] -= state.gradient[std::size_t(18) * at + i];
      restrict_to(move, gradient, x);
      solve(move.factor, move.size, x);
      prolongate(move, x, change);
      double *total = &state.change[std::size_t(18) * move.face];
      for (unsigned int i = 0; i < 18; ++i)
        total[i] += change[i];
      unsigned int rows[18];
      for (const unsigned int at : move.cells)
        if (at != none)
          {
            for (unsigned int i = 0; i < 18; ++i)
              rows[i] = 18 * (at % 4) + i;
            update(&state.gradient[std::size_t(n) * (at / 4)],
                   &state.flexibility[std::size_t(n) * n * (at / 4)],
                   rows,
                   change,
                   18);
          }
    }

    TETRADAPT_INLINE void
    make(State &state, const RingMove &move)
    {
      double x[6] = {};
      for (unsigned int t = move.begin; t < move.end; ++t)
        {
          const auto   &turn = state.turns[t];
          const double *g    = &state.gradient[std::size_t(n) * turn.cell];
          for (unsigned int p = 0; p < 2; ++p)
            for (unsigned int i = 0; i < move.size; ++i)
              {
                const unsigned int a = move.components[i];
                x[i] -= turn.sign[p] * g[turn.first[p] + turn.at[p][a / 3] + a % 3];
              }
        }
      solve(move.factor, move.size, x);
      for (unsigned int t = move.begin; t < move.end; ++t)
        {
          const auto  &turn = state.turns[t];
          unsigned int rows[12], k = 0;
          double       change[12];
          for (unsigned int p = 0; p < 2; ++p)
            for (unsigned int i = 0; i < move.size; ++i, ++k)
              {
                const unsigned int a = move.components[i], at = turn.at[p][a / 3] + a % 3;
                rows[k]   = turn.first[p] + at;
                change[k] = turn.sign[p] * x[i];
                // Each face but the last is the way in of one cell.
                if (p == 0
                    || (t + 1 == move.end && turn.face[1] != state.turns[move.begin].face[0]))
                  state.change[std::size_t(18) * turn.face[p] + at] += change[k];
              }
          update(&state.gradient[std::size_t(n) * turn.cell],
                 &state.flexibility[std::size_t(n) * n * turn.cell],
                 rows,
                 change,
                 k);
        }
    }
  } // namespace

  TETRADAPT_CLONES void
  make_moves(State &state)
  {
    // Cell by cell, while its matrix is at hand.
    auto ring = state.ring_moves.begin();
    auto face = state.face_moves.begin();
    for (unsigned int cell = 0; cell < state.n_cells; ++cell)
      {
        for (; face != state.face_moves.end() && face->owner == cell; ++face)
          make(state, *face);
        for (; ring != state.ring_moves.end() && ring->owner == cell; ++ring)
          make(state, *ring);
      }
  }
} // namespace tetradapt::estimate
