// SPDX-License-Identifier: AGPL-3.0-or-later
#include "improvement.h"

#include "tetradapt/compare/parallel.h"
#include "tetradapt/core/failure.h"
#include "tetradapt/mesh/space_curve.h"

#include <deal.II/base/numbers.h>

#include <algorithm>

namespace tetradapt::estimate
{
  namespace
  {
    constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;

    /** Where each rank's share of the cells begins, and where the last one ends. */
    std::vector<unsigned int>
    slice_ends(const unsigned int n_cells, MPI_Comm communicator)
    {
      std::vector<double> begins(compare::n_ranks(communicator) + 1, 0.);
      begins[compare::this_rank(communicator)] = compare::own_slice(n_cells, communicator).begin;
      compare::sum_over_ranks(begins, communicator);
      begins.back() = n_cells;
      return {begins.begin(), begins.end()};
    }

    /** The place of every cell along a curve through space. */
    std::vector<unsigned int>
    places_along_curve(const mesh::TetMesh &mesh)
    {
      std::vector<Point<3>> centers(mesh.n_cells());
      for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
        for (const unsigned int point : mesh.cells[cell])
          centers[cell] += 0.25 * Tensor<1, 3>(mesh.points[point]);
      const auto                box   = mesh::bounding_box(mesh);
      const auto                order = mesh::SpaceCurve(box.first, box.second).order(centers);
      std::vector<unsigned int> places(mesh.n_cells());
      for (unsigned int i = 0; i < order.size(); ++i)
        places[order[i]] = i;
      return places;
    }

    /** Improves the tractions part by part. */
    class Improvement
    {
    public:
      Improvement(const mesh::TetMesh &mesh,
                  const CellFaces     &faces,
                  const TractionMoves &moves,
                  const CellStates    &states,
                  MPI_Comm             communicator)
        : mesh(mesh), faces(faces), moves(moves), relaxation(mesh, faces, moves, states),
          communicator(communicator), face_cells(faces.n_faces, {{none, none}}),
          part(mesh.n_cells(), none), place(places_along_curve(mesh)), face_done(faces.n_faces, 0),
          ring_done(moves.n_rings(), 0)
      {
        for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
          for (const auto &side : faces.sides[cell])
            face_cells[side.face][side.second ? 1 : 0] = cell;
      }

      void
      run(std::vector<double> &moments)
      {
        // First each rank its own cells.
        const auto         ends = slice_ends(mesh.n_cells(), communicator);
        const unsigned int rank = compare::this_rank(communicator);
        core::together(communicator, [&] {
          for (unsigned int r = 0; r + 1 < ends.size(); ++r)
            {
              std::vector<unsigned int> cells;
              for (unsigned int cell = ends[r]; cell < ends[r + 1]; ++cell)
                cells.push_back(cell);
              relax_parts(cells, r == rank, moments);
            }
        });
        exchange(ends, moments);
        // Then all ranks alike what lies between the parts. The parts of a later
        // step are small; a few steps are enough.
        for (unsigned int step = 0; step < 6; ++step)
          {
            const auto cells = unfinished_cells();
            if (cells.empty())
              break;
            std::fill(part.begin(), part.end(), none);
            n_parts = 0;
            relax_parts(cells, true, moments);
          }
      }

    private:
      void
      relax_parts(std::vector<unsigned int> cells, const bool here, std::vector<double> &moments)
      {
        // Compact parts have small borders, over which nothing relaxes.
        std::sort(cells.begin(), cells.end(), [&](unsigned int a, unsigned int b) {
          return place[a] < place[b];
        });
        const std::size_t n
          = (cells.size() + TractionRelaxation::most_cells - 1) / TractionRelaxation::most_cells;
        for (std::size_t p = 0; p < n; ++p, ++n_parts)
          {
            const std::vector<unsigned int> own(cells.begin() + cells.size() * p / n,
                                                cells.begin() + cells.size() * (p + 1) / n);
            for (const unsigned int cell : own)
              part[cell] = n_parts;
            if (here)
              relaxation.relax(own, moments);
          }
      }

      /** Marks the moves inside one part and lists the cells of the others. */
      std::vector<unsigned int>
      unfinished_cells()
      {
        std::vector<char> touched(mesh.n_cells(), 0);
        for (unsigned int face = 0; face < faces.n_faces; ++face)
          if (face_done[face] == 0 && moves.face_components[face] != 0)
            {
              const auto &cells = face_cells[face];
              if (part[cells[0]] != none && (cells[1] == none || part[cells[1]] == part[cells[0]]))
                face_done[face] = 1;
              else
                touched[cells[0]] = touched[cells[1] == none ? cells[0] : cells[1]] = 1;
            }
        for (unsigned int ring = 0; ring < moves.n_rings(); ++ring)
          if (ring_done[ring] == 0)
            {
              const unsigned int first = part[moves.turns[moves.ring_begin[ring]].cell];
              bool               done  = first != none;
              for (unsigned int t = moves.ring_begin[ring]; t < moves.ring_begin[ring + 1]; ++t)
                done = done && part[moves.turns[t].cell] == first;
              ring_done[ring] = done ? 1 : 0;
              if (!done)
                for (unsigned int t = moves.ring_begin[ring]; t < moves.ring_begin[ring + 1]; ++t)
                  touched[moves.turns[t].cell] = 1;
            }
        // And the cells around, for the changes to spread.
        std::vector<char> points(mesh.n_points(), 0);
        for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
          if (touched[cell] != 0)
            for (const unsigned int point : mesh.cells[cell])
              points[point] = 1;
        std::vector<unsigned int> cells;
        for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
          {
            const auto &c = mesh.cells[cell];
            if (points[c[0]] + points[c[1]] + points[c[2]] + points[c[3]] > 0)
              cells.push_back(cell);
          }
        return cells;
      }

      /** Gives every rank all moments: from the rank of the face's first cell. */
      void
      exchange(const std::vector<unsigned int> &ends, std::vector<double> &moments) const
      {
        if (ends.size() == 2)
          return;
        const unsigned int rank = compare::this_rank(communicator);
        for (unsigned int face = 0; face < faces.n_faces; ++face)
          if (face_cells[face][0] < ends[rank] || face_cells[face][0] >= ends[rank + 1])
            std::fill_n(moments.begin() + 18 * std::size_t(face), 18, 0.);
        compare::sum_over_ranks(moments, communicator);
      }

      const mesh::TetMesh                     &mesh;
      const CellFaces                         &faces;
      const TractionMoves                     &moves;
      TractionRelaxation                       relaxation;
      MPI_Comm                                 communicator;
      std::vector<std::array<unsigned int, 2>> face_cells;
      std::vector<unsigned int>                part;  ///< of a cell in this step; or none
      std::vector<unsigned int>                place; ///< of a cell, see places_along_curve()
      std::vector<char>                        face_done, ring_done;
      unsigned int                             n_parts = 0;
    };
  } // namespace

  void
  improve_tractions(const mesh::TetMesh &mesh,
                    const CellFaces     &faces,
                    const TractionMoves &moves,
                    const CellStates    &states,
                    MPI_Comm             communicator,
                    std::vector<double> &moments)
  {
    Improvement(mesh, faces, moves, states, communicator).run(moments);
  }
} // namespace tetradapt::estimate
