// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/matrix_free_stiffness.h"

#include "stiffness_kernel.h"

#include <algorithm>

namespace tetradapt::mechanics
{
  namespace
  {
    TangentForm
    form_of(const TangentField &tangents)
    {
      const bool one = tangents.points_per_cell() == 1;
      if (tangents.is_full())
        {
          AssertThrow(!one, dealii::ExcNotImplemented()); // laws have one at each point
          return TangentForm::full_per_point;
        }
      return tangents.is_isotropic() ? TangentForm::isotropic
             : one                   ? TangentForm::one_per_cell
                                     : TangentForm::four_per_cell;
    }

    /** Writes the tangents of a cell, times @p weight, to every W-th entry of @p to. */
    template <typename Number>
    void
    store_tangents(
      const TangentField &tangents, TangentForm form, unsigned int cell, double weight, Number *to)
    {
      constexpr unsigned int W = stiffness_lanes<Number>;
      if (form == TangentForm::isotropic)
        {
          const VoigtMatrix &D = tangents.at(cell, 0);
          to[0]                = weight * D[0][1];
          to[W]                = weight * D[3][3];
          return;
        }
      for (unsigned int q = 0; q < tangents.points_per_cell(); ++q)
        {
          if (tangents.is_full())
            {
              for (const double entry : tangents.full(cell, q))
                {
                  *to = weight * entry;
                  to += W;
                }
              continue;
            }
          const VoigtMatrix &D = tangents.at(cell, q);
          for (unsigned int i = 0; i < 6; ++i)
            for (unsigned int j = i; j < 6; ++j, to += W)
              *to = weight * D[i][j];
        }
    }
  } // namespace

  namespace
  {
    template <typename Number>
    Tensor<1, 3>
    at_node(const Number *x, const unsigned int node)
    {
      const std::size_t first = 3 * std::size_t(node);
      Tensor<1, 3>      value;
      for (unsigned int c = 0; c < 3; ++c)
        value[c] = x[first + c];
      return value;
    }

    template <typename Number>
    void
    set_node(Number *x, const unsigned int node, const Tensor<1, 3> &value)
    {
      const std::size_t first = 3 * std::size_t(node);
      for (unsigned int c = 0; c < 3; ++c)
        x[first + c] = static_cast<Number>(value[c]);
    }

    template <typename Number>
    Tensor<1, 3>
    multiply(const std::array<Number, 9> &block, const Tensor<1, 3> &x)
    {
      Tensor<1, 3> result;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          result[i] += block[3 * i + j] * x[j];
      return result;
    }
  } // namespace

  template <typename Number>
  MatrixFreeStiffness<Number>::MatrixFreeStiffness(const fem::Space           &space,
                                                   const TangentField         &tangents,
                                                   const fem::FixedUnknowns   &fixed,
                                                   const double                scale,
                                                   const SpringMatrix<double> *springs_to_add)
    : space(space), fixed(fixed), form(form_of(tangents))
  {
    if (springs_to_add != nullptr)
      springs.emplace(*springs_to_add, scale);
    store_cells(tangents, scale);
    compute_diagonal();
  }

  template <typename Number>
  void
  MatrixFreeStiffness<Number>::store_cells(const TangentField &tangents, const double scale)
  {
    constexpr unsigned int    W     = stiffness_lanes<Number>;
    const unsigned int        size  = tangent_size(form);
    std::vector<unsigned int> cells = space.touching_cells();
    const auto first_with_ghosts = std::stable_partition(cells.begin(), cells.end(), [&](auto c) {
      for (unsigned int i = 0; i < 10; ++i)
        if (space.local_node(space.cell_node(c, i)) >= space.n_owned_nodes())
          return false;
      return true;
    });
    n_own_batches                = (first_with_ghosts - cells.begin()) / W;
    n_batches                    = (cells.size() + W - 1) / W;
    nodes.resize_fast(10 * W * std::size_t(n_batches));
    at_end.assign(n_batches, 0);
    gradients.resize_fast(9 * W * std::size_t(n_batches));
    tangent_values.resize(size * W * std::size_t(n_batches)); // zero: lanes left over do nothing
    for (unsigned int k = 0; k < n_batches * W; ++k)
      {
        const unsigned int cell  = cells[std::min<std::size_t>(k, cells.size() - 1)];
        const std::size_t  batch = k / W, lane = k % W;
        for (unsigned int i = 0; i < 10; ++i)
          {
            const unsigned int node            = space.local_node(space.cell_node(cell, i));
            nodes[(10 * batch + i) * W + lane] = node;
            if (node + 1 == space.n_local_nodes())
              at_end[batch] = 1;
          }
        const auto g = mesh::barycentric_gradients(space.tet_mesh(), cell);
        for (unsigned int i = 0; i < 9; ++i)
          gradients[(9 * batch + i) * W + lane] = g[1 + i / 3][i % 3];
        if (k < cells.size())
          store_tangents(tangents,
                         form,
                         cell,
                         0.25 * scale * mesh::cell_volume(space.tet_mesh(), cell),
                         &tangent_values[size * W * batch + lane]);
      }
  }

  template <typename Number>
  void
  MatrixFreeStiffness<Number>::compute_diagonal()
  {
    std::vector<Block> blocks(space.n_local_nodes(), Block{});
    if (n_batches > 0)
      add_diagonal_blocks<Number>(
        {nodes.data(), at_end.data(), gradients.data(), tangent_values.data(), form},
        0,
        n_batches,
        blocks.data()->data());
    blocks.resize(space.n_owned_nodes());
    for (std::size_t k = 0; springs && k < springs->rows().size(); ++k)
      for (unsigned int i = 0; i < 9; ++i)
        blocks[springs->rows()[k]][i] += springs->diagonal(k)[i];
    for (const unsigned int unknown : fixed.unknowns())
      if (unknown < 3 * blocks.size())
        {
          Block             &block = blocks[unknown / 3];
          const unsigned int c     = unknown % 3;
          for (unsigned int j = 0; j < 3; ++j)
            if (j != c)
              block[3 * c + j] = block[3 * j + c] = 0;
        }
    for (const fem::InclinedNode &inclined : fixed.inclined())
      if (inclined.node < blocks.size())
        fem::build_in(inclined.held, blocks[inclined.node]);
    diagonal = std::move(blocks);
  }

  template <typename Number>
  void
  MatrixFreeStiffness<Number>::add_forces(unsigned int  begin,
                                          unsigned int  end,
                                          const Number *x,
                                          Number       *y) const
  {
    apply_stiffness<Number>(
      {nodes.data(), at_end.data(), gradients.data(), tangent_values.data(), form},
      begin,
      end,
      x,
      y);
  }

  template <typename Number>
  void
  MatrixFreeStiffness<Number>::vmult(VectorOf<Number>       &destination,
                                     const VectorOf<Number> &source) const
  {
    // Fixed unknowns count as zero.
    const std::size_t n_fixed = std::lower_bound(fixed.unknowns().begin(),
                                                 fixed.unknowns().end(),
                                                 3 * space.n_owned_nodes())
                                - fixed.unknowns().begin(); // owned ones
    // Directions that are no components are never zero to the last digit.
    const auto       &inclined = fixed.inclined();
    const std::size_t n_inclined
      = std::lower_bound(inclined.begin(),
                         inclined.end(),
                         space.n_owned_nodes(),
                         [](const fem::InclinedNode &a, unsigned int b) { return a.node < b; })
        - inclined.begin();
    const VectorOf<Number> *free = &source;
    if (n_inclined > 0
        || std::any_of(fixed.unknowns().begin(),
                       fixed.unknowns().begin() + n_fixed,
                       [&](const unsigned int unknown) {
                         return source.local_element(unknown) != 0;
                       }))
      {
        masked.reinit(source, true);
        std::copy_n(source.begin(), source.locally_owned_size(), masked.begin());
        for (std::size_t k = 0; k < n_fixed; ++k)
          masked.local_element(fixed.unknowns()[k]) = 0;
        for (std::size_t k = 0; k < n_inclined; ++k)
          {
            const Tensor<1, 3> x = at_node(source.begin(), inclined[k].node);
            set_node(masked.begin(), inclined[k].node, x - inclined[k].held * x);
          }
        free = &masked;
      }
    free->update_ghost_values_start();
    Number *y = destination.begin();
    std::fill(y, y + 3 * std::size_t(space.n_local_nodes()), Number(0));
    add_forces(0, n_own_batches, free->begin(), y);
    free->update_ghost_values_finish();
    add_forces(n_own_batches, n_batches, free->begin(), y);
    if (springs)
      springs->add_product(free->begin(), y);
    free->zero_out_ghost_values();
    for (std::size_t k = 0; k < n_fixed; ++k)
      {
        const unsigned int unknown = fixed.unknowns()[k];
        y[unknown] = diagonal[unknown / 3][4 * (unknown % 3)] * source.local_element(unknown);
      }
    for (std::size_t k = 0; k < n_inclined; ++k)
      {
        const unsigned int node  = inclined[k].node;
        const auto        &held  = inclined[k].held;
        const Tensor<1, 3> force = at_node(y, node);
        set_node(y,
                 node,
                 force - held * force
                   + multiply(diagonal[node], held * at_node(source.begin(), node)));
      }
    destination.zero_out_ghost_values();
  }

  template <typename Number>
  VectorOf<Number>
  MatrixFreeStiffness<Number>::right_hand_side(const Vector &forces) const
  {
    VectorOf<Number> b(space.vector_layout());
    if (!fixed.is_homogeneous())
      {
        std::vector<Number> x(3 * std::size_t(space.n_local_nodes()), Number(0));
        for (std::size_t k = 0; k < fixed.unknowns().size(); ++k)
          x[fixed.unknowns()[k]] = fixed.values()[k];
        for (const fem::InclinedNode &inclined : fixed.inclined())
          set_node(x.data(), inclined.node, inclined.value);
        add_forces(0, n_batches, x.data(), b.begin());
        if (springs)
          springs->add_product(x.data(), b.begin());
        b.zero_out_ghost_values();
      }
    for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
      for (unsigned int c = 0; c < 3; ++c)
        {
          Number &value = b.local_element(3 * node + c);
          value = fixed.is_fixed(node, c) ? Number(diagonal[node][4 * c] * fixed.value(node, c))
                                          : Number(forces.local_element(3 * node + c)) - value;
        }
    for (const fem::InclinedNode &inclined : fixed.inclined())
      if (inclined.node < space.n_owned_nodes())
        {
          const Tensor<1, 3> force = at_node(b.begin(), inclined.node);
          set_node(b.begin(),
                   inclined.node,
                   force - inclined.held * force
                     + multiply(diagonal[inclined.node], inclined.value));
        }
    return b;
  }

  template class MatrixFreeStiffness<double>;
  template class MatrixFreeStiffness<float>;
} // namespace tetradapt::mechanics
