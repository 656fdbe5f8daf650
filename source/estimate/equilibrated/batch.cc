// SPDX-License-Identifier: AGPL-3.0-or-later
#include "batch.h"

#include "tetradapt/core/clones.h"

#include <cmath>

namespace tetradapt::estimate
{
  namespace
  {
    using Element                   = EquilibratedElement;
    constexpr unsigned int n_stress = Element::n_stress, n_free = Element::n_free,
                           n_loads = Element::n_loads, n_moments = Element::n_moments;

    /** What both functions below need. */
    struct Workspace
    {
      Lanes stress[n_stress]; ///< particular stress
      Lanes strain[n_stress]; ///< times the shape
      Lanes factor[n_free * (n_free + 1) / 2];
      Lanes reduced[n_free]; ///< factor^-1 times the products of strain and free stresses
    };

    /** Sums of nine products each with the shape. */
    TETRADAPT_INLINE void
    contract(const double *products, const Lanes *shape, Lanes *sums)
    {
      Lanes sum[9] = {};
      for (unsigned int pq = 0; pq < 21; ++pq, products += 9)
        for (unsigned int k = 0; k < 9; ++k)
          sum[k] += products[k] * shape[pq];
      for (unsigned int k = 0; k < 9; ++k)
        sums[k] = sum[k];
    }

    /** Products of @p n rows of @p table, of n_stress numbers, with @p x. */
    TETRADAPT_INLINE void
    multiply(const double *table, const unsigned int n, const Lanes *x, Lanes *result)
    {
      for (unsigned int a = 0; a < n; a += 6, table += 6 * n_stress)
        {
          Lanes sum[6] = {};
          for (unsigned int k = 0; k < n_stress; ++k)
            for (unsigned int i = 0; i < 6; ++i)
              sum[i] += table[i * n_stress + k] * x[k];
          for (unsigned int i = 0; i < 6; ++i)
            result[a + i] = sum[i];
        }
    }

    /** Cholesky's factor in place, with the inverse of its diagonal. */
    TETRADAPT_INLINE void
    factorise(Lanes *matrix)
    {
      for (unsigned int j = 0; j < n_free; ++j)
        {
          Lanes &diagonal = matrix[j * (j + 1) / 2 + j];
          for (unsigned int lane = 0; lane < CellBatch::size; ++lane)
            diagonal[lane] = 1. / std::sqrt(diagonal[lane]);
          for (unsigned int i = j + 1; i < n_free; ++i)
            matrix[i * (i + 1) / 2 + j] *= diagonal;
          for (unsigned int i = j + 1; i < n_free; ++i)
            {
              Lanes      *row   = matrix + i * (i + 1) / 2;
              const Lanes value = row[j];
              for (unsigned int k = j + 1; k <= i; ++k)
                row[k] -= value * matrix[k * (k + 1) / 2 + j];
            }
        }
    }

    /** x becomes factor^-1 x. */
    TETRADAPT_INLINE void
    substitute(const Lanes *factor, Lanes *x)
    {
      for (unsigned int b = 0; b < n_free; ++b)
        {
          x[b] *= factor[b * (b + 1) / 2 + b];
          for (unsigned int a = b + 1; a < n_free; ++a)
            x[a] -= factor[a * (a + 1) / 2 + b] * x[b];
        }
    }

    TETRADAPT_INLINE void
    apply_shape(const Lanes *shape, const Lanes *stress, Lanes *strain)
    {
      Lanes        sum[6] = {};
      unsigned int pq     = 0;
      for (unsigned int p = 0; p < 6; ++p)
        {
          sum[p] += shape[pq++] * stress[p];
          for (unsigned int q = p + 1; q < 6; ++q, ++pq)
            {
              sum[p] += shape[pq] * stress[q];
              sum[q] += shape[pq] * stress[p];
            }
        }
      for (unsigned int p = 0; p < 6; ++p)
        strain[p] = sum[p];
    }

    /** Adds the stress that balances the quadratic body force: what is of degree 2 to
     * @p stress, of the other polynomials the energy. */
    TETRADAPT_INLINE void
    add_quadratic(const CellBatch &batch, Lanes *stress, Lanes &energy)
    {
      const double *table = Element::quadratic_forces().data();
      for (unsigned int k = 0; k < 2 * n_stress; k += 6)
        {
          Lanes sum[6] = {}, strain[6];
          for (unsigned int l = 0; l < Element::n_quadratic; ++l)
            for (unsigned int p = 0; p < 6; ++p)
              sum[p] += table[2 * n_stress * l + k + p] * batch.quadratic[l];
          // 120 numbers a part, the first 60 of degree 2.
          const unsigned int part = k / 120, place = k % 120;
          if (place < 60)
            for (unsigned int p = 0; p < 6; ++p)
              stress[60 * part + place + p] += sum[p];
          else
            {
              apply_shape(batch.shape, sum, strain);
              for (unsigned int p = 0; p < 6; ++p)
                energy += sum[p] * strain[p];
            }
        }
    }

    TETRADAPT_CLONES void
    minimise(const Element &element, CellBatch &batch, Workspace &work)
    {
      // Eight coefficients at a time stay in registers.
      for (unsigned int k = 0; k < n_stress; k += 8)
        {
          Lanes         sum[8] = {};
          const double *row    = element.particular.data() + k;
          for (unsigned int l = 0; l < n_loads; ++l, row += n_stress)
            for (unsigned int i = 0; i < 8; ++i)
              sum[i] += row[i] * batch.loads[l];
          for (unsigned int i = 0; i < 8; ++i)
            work.stress[k + i] = sum[i];
        }
      Lanes energy = {};
      if (batch.has_quadratic)
        add_quadratic(batch, work.stress, energy);
      for (unsigned int k = 0; k < n_stress; k += 6)
        {
          apply_shape(batch.shape, work.stress + k, work.strain + k);
          for (unsigned int p = 0; p < 6; ++p)
            energy += work.strain[k + p] * work.stress[k + p];
        }
      multiply(element.free_stress.data(), n_free, work.strain, work.reduced);
      for (unsigned int k = 0; k < n_free * (n_free + 1) / 2; k += 9)
        contract(element.free_products.data() + 21 * k, batch.shape, work.factor + k);
      factorise(work.factor);
      substitute(work.factor, work.reduced);
      for (unsigned int a = 0; a < n_free; ++a)
        energy -= work.reduced[a] * work.reduced[a];
      batch.energy = energy;
    }

    /** Products of each moment's stress with the free stresses, times the inverse of
     * the factor; the gradient. */
    TETRADAPT_CLONES void
    differentiate(const Element &element, CellBatch &batch, const Workspace &work, Lanes *mixed)
    {
      multiply(element.particular.data(), n_moments, work.strain, batch.gradient);
      for (unsigned int l = 0; l < n_moments; ++l, mixed += n_free)
        {
          const double *products = element.mixed_products.data() + 21 * n_free * l;
          contract(products, batch.shape, mixed);
          contract(products + 21 * 9, batch.shape, mixed + 9);
          substitute(work.factor, mixed);
          for (unsigned int a = 0; a < n_free; ++a)
            batch.gradient[l] -= mixed[a] * work.reduced[a];
        }
      for (unsigned int n = 0; n < n_moments; n += 3)
        {
          Lanes *g = batch.gradient + n, real[3] = {};
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int c = 0; c < 3; ++c)
              real[c] += batch.inverse[3 * i + c] * g[i];
          for (unsigned int c = 0; c < 3; ++c)
            g[c] = real[c];
        }
    }

    TETRADAPT_CLONES void
    differentiate_twice(const Element &element, CellBatch &batch, const Lanes *mixed)
    {
      const double *products = element.moment_products.data();
      Lanes        *result   = batch.flexibility;
      for (unsigned int n = 0; n < n_moments; n += 3)
        for (unsigned int m = 0; m <= n; m += 3, result += 9, products += 21 * 9)
          {
            const Lanes *row = mixed + n * n_free, *column = mixed + m * n_free;
            Lanes        sum[9], half[9];
            contract(products, batch.shape, sum);
            for (unsigned int a = 0; a < n_free; ++a)
              for (unsigned int i = 0; i < 3; ++i)
                for (unsigned int j = 0; j < 3; ++j)
                  sum[3 * i + j] -= row[i * n_free + a] * column[j * n_free + a];
            // To the moments of the real cell.
            for (unsigned int i = 0; i < 3; ++i)
              for (unsigned int d = 0; d < 3; ++d)
                half[3 * i + d] = sum[3 * i] * batch.inverse[d]
                                  + sum[3 * i + 1] * batch.inverse[3 + d]
                                  + sum[3 * i + 2] * batch.inverse[6 + d];
            for (unsigned int c = 0; c < 3; ++c)
              for (unsigned int d = 0; d < 3; ++d)
                result[3 * c + d] = batch.inverse[c] * half[d] + batch.inverse[3 + c] * half[3 + d]
                                    + batch.inverse[6 + c] * half[6 + d];
          }
    }
  } // namespace

  void
  minimise_energy(CellBatch &batch)
  {
    Workspace work;
    minimise(Element::instance(), batch, work);
  }

  void
  minimal_stress(CellBatch &batch, Lanes *stress)
  {
    const Element &element = Element::instance();
    Workspace      work;
    minimise(element, batch, work);
    for (unsigned int k = 0; k < n_stress; ++k)
      stress[k] = work.stress[k];
    for (unsigned int a = n_free; a-- > 0;)
      {
        Lanes &x = work.reduced[a];
        x *= work.factor[a * (a + 1) / 2 + a];
        for (unsigned int b = 0; b < a; ++b)
          work.reduced[b] -= work.factor[a * (a + 1) / 2 + b] * x;
        for (unsigned int k = 0; k < n_stress; ++k)
          stress[k] -= element.free_stress[a * n_stress + k] * x;
      }
  }

  void
  differentiate_energy(CellBatch &batch)
  {
    Workspace work;
    Lanes     mixed[n_moments * n_free];
    minimise(Element::instance(), batch, work);
    differentiate(Element::instance(), batch, work, mixed);
    differentiate_twice(Element::instance(), batch, mixed);
  }
} // namespace tetradapt::estimate
