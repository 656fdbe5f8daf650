// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/trilinos_types.h"

#include "tetradapt/mechanics/rigid_motions.h"

#include <deal.II/base/index_set.h>

namespace tetradapt::solve
{
  std::unique_ptr<PointMatrix>
  to_point_matrix(const mechanics::BlockMatrix &matrix, const mechanics::DisplacementSpace &space)
  {
    using dealii::TrilinosWrappers::types::int_type;
    const auto      &layout = *matrix.vector_layout();
    const Epetra_Map rows
      = layout.locally_owned_range().make_trilinos_map(space.communicator(), false);

    std::vector<int> row_lengths(3 * matrix.n_rows());
    for (unsigned int row = 0; row < matrix.n_rows(); ++row)
      for (unsigned int i = 0; i < 3; ++i)
        row_lengths[3 * row + i] = 3 * (matrix.row_end(row) - matrix.row_begin(row));
    auto result = std::make_unique<PointMatrix>(Copy, rows, row_lengths.data(), true);

    std::vector<int_type> columns;
    std::vector<double>   values;
    for (unsigned int row = 0; row < matrix.n_rows(); ++row)
      for (unsigned int i = 0; i < 3; ++i)
        {
          columns.clear();
          values.clear();
          for (std::size_t k = matrix.row_begin(row); k < matrix.row_end(row); ++k)
            for (unsigned int j = 0; j < 3; ++j)
              {
                columns.push_back(layout.local_to_global(3 * matrix.column(k) + j));
                values.push_back(matrix.block(k)[3 * i + j]);
              }
          result->InsertGlobalValues(static_cast<int_type>(layout.local_to_global(3 * row + i)),
                                     columns.size(),
                                     values.data(),
                                     columns.data());
        }
    result->FillComplete();
    result->OptimizeStorage();
    return result;
  }

  std::unique_ptr<MultiVector>
  rigid_body_modes(const PointMatrix                       &matrix,
                   const mechanics::DisplacementSpace      &space,
                   const mechanics::PrescribedDisplacement &prescribed)
  {
    const auto  &mesh   = space.tet_mesh();
    const auto   box    = mesh::bounding_box(mesh);
    const auto   centre = box.first + 0.5 * (box.second - box.first);
    const double length = 0.5 * (box.second - box.first).norm();
    auto         modes  = std::make_unique<MultiVector>(matrix.RowMap(), 6);
    for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
      {
        const unsigned int field_node = space.field_node(node);
        for (unsigned int k = 0; k < 6; ++k)
          {
            const auto motion = mechanics::rigid_motion(k, mesh.points[field_node], centre, length);
            for (unsigned int c = 0; c < 3; ++c)
              (*modes)[k][3 * node + c] = prescribed.is_fixed(field_node, c) ? 0. : motion[c];
          }
      }
    return modes;
  }
} // namespace tetradapt::solve
