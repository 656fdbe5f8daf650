// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/fem/triangulation.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>
#include <deal.II/grid/tria_accessor.h>
#include <deal.II/grid/tria_iterator.h>

#include <algorithm>

namespace tetradapt::fem
{
  namespace
  {
    constexpr unsigned int invalid = dealii::numbers::invalid_unsigned_int;

    /** Finds a boundary face of a mesh by its points. */
    class FaceFinder
    {
    public:
      explicit FaceFinder(const mesh::TetMesh &mesh)
        : faces(mesh.faces), first(mesh.n_points(), invalid), next(mesh.faces.size())
      {
        for (unsigned int f = 0; f < faces.size(); ++f)
          {
            const auto   &v        = faces[f].vertices;
            unsigned int &smallest = first[*std::min_element(v.begin(), v.end())];
            next[f]                = smallest;
            smallest               = f;
          }
      }

      /** numbers::invalid_unsigned_int if there is none. */
      unsigned int
      find(std::array<unsigned int, 3> points) const
      {
        std::sort(points.begin(), points.end());
        for (unsigned int f = first[points[0]]; f != invalid; f = next[f])
          {
            auto vertices = faces[f].vertices;
            std::sort(vertices.begin(), vertices.end());
            if (vertices == points)
              return f;
          }
        return invalid;
      }

    private:
      const std::vector<mesh::BoundaryFace> &faces;
      std::vector<unsigned int>              first; ///< face, by its smallest point
      std::vector<unsigned int>              next;  ///< face with the same smallest point
    };
  } // namespace

  Triangulation::Triangulation(std::shared_ptr<const mesh::TetMesh> mesh,
                               const MPI_Comm                       communicator)
    : DistributedTriangulationBase<3>(communicator), cell_partition(std::move(mesh), communicator)
  {
    choose_cells();
    create();
    set_boundary_ids();
  }

  void
  Triangulation::choose_cells()
  {
    const auto        &order = cell_partition.order();
    const unsigned int begin = cell_partition.first_cell(my_subdomain);
    const unsigned int end   = cell_partition.first_cell(my_subdomain + 1);
    std::vector<bool>  is_near(tet_mesh().n_points(), false); // points of the rank's cells
    for (unsigned int k = begin; k < end; ++k)
      for (const unsigned int point : tet_mesh().cells[order[k]])
        is_near[point] = true;
    for (unsigned int k = 0; k < order.size(); ++k)
      {
        const auto &points = tet_mesh().cells[order[k]];
        if ((begin <= k && k < end)
            || std::any_of(points.begin(), points.end(), [&](auto p) { return is_near[p]; }))
          positions.push_back(k);
      }
    // deal.II makes no triangulation without cells: a rank without any gets one that is not its
    // own, nor a ghost.
    if (positions.empty())
      positions.push_back(0);
  }

  void
  Triangulation::create()
  {
    const mesh::TetMesh             &mesh = tet_mesh();
    std::vector<unsigned int>        local_points(mesh.n_points(), invalid);
    std::vector<dealii::Point<3>>    points;
    std::vector<dealii::CellData<3>> cells(positions.size(), dealii::CellData<3>(4));
    for (unsigned int c = 0; c < cells.size(); ++c)
      {
        const unsigned int cell = mesh_cell(c);
        for (unsigned int i = 0; i < 4; ++i)
          {
            unsigned int &local = local_points[mesh.cells[cell][i]];
            if (local == invalid)
              {
                local = points.size();
                points.push_back(mesh.points[mesh.cells[cell][i]]);
              }
            cells[c].vertices[i] = local;
          }
        cells[c].material_id = mesh.regions[cell];
      }
    dealii::Triangulation<3>::create_triangulation(points, cells, dealii::SubCellData());
    const bool is_empty
      = cell_partition.first_cell(my_subdomain) == cell_partition.first_cell(my_subdomain + 1);
    unsigned int owner = 0;
    for (const auto &cell : active_cell_iterators())
      {
        while (positions[cell->index()] >= cell_partition.first_cell(owner + 1))
          ++owner;
        cell->set_subdomain_id(is_empty ? dealii::numbers::artificial_subdomain_id : owner);
      }
    update_number_cache();
  }

  void
  Triangulation::set_boundary_ids()
  {
    const mesh::TetMesh &mesh = tet_mesh();
    const FaceFinder     finder(mesh);
    for (const auto &cell : active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->at_boundary(f))
          {
            // deal.II's face f of a tetrahedron lies opposite to vertex 3 - f.
            auto points     = mesh.cells[mesh_cell(cell->index())];
            points[3 - f]   = points[3];
            const auto face = finder.find({{points[0], points[1], points[2]}});
            if (face != invalid)
              cell->face(f)->set_boundary_id(mesh.faces[face].patch + 1);
          }
  }

  bool
  Triangulation::is_multilevel_hierarchy_constructed() const
  {
    return false;
  }

  void
  Triangulation::save(const std::string &) const
  {
    throw dealii::ExcNotImplemented();
  }

  void
  Triangulation::load(const std::string &)
  {
    throw dealii::ExcNotImplemented();
  }

#if !DEAL_II_VERSION_GTE(9, 7, 0)
  void
  Triangulation::load(const std::string &, const bool)
  {
    throw dealii::ExcNotImplemented();
  }
#endif

#if !DEAL_II_VERSION_GTE(9, 6, 0)
  void
  Triangulation::update_cell_relations()
  {
    this->local_cell_relations.clear();
  }
#endif

  dealii::types::coarse_cell_id
  Triangulation::coarse_cell_index_to_coarse_cell_id(const unsigned int index) const
  {
    return positions[index];
  }

  unsigned int
  Triangulation::coarse_cell_id_to_coarse_cell_index(const dealii::types::coarse_cell_id id) const
  {
    const auto found = std::lower_bound(positions.begin(), positions.end(), id);
    return found != positions.end() && *found == id ? found - positions.begin() : invalid;
  }
} // namespace tetradapt::fem
