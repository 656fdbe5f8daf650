// SPDX-License-Identifier: AGPL-3.0-or-later
#include "relaxation.h"

#include "batch.h"
#include "sweeps.h"

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace tetradapt::estimate
{
  namespace
  {
    constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;
    constexpr unsigned int n    = TractionRelaxation::n;
  } // namespace

  TractionRelaxation::TractionRelaxation(const mesh::TetMesh &mesh,
                                         const CellFaces     &faces,
                                         const TractionMoves &moves,
                                         const CellStates    &states)
    : mesh(mesh), faces(faces), moves(moves), states(states), local_cell(mesh.n_cells(), none),
      local_face(faces.n_faces, none)
  {
  }

  void
  TractionRelaxation::number(const std::vector<unsigned int> &cells)
  {
    face_number.clear();
    cell_faces.resize(4 * cells.size());
    for (unsigned int c = 0; c < cells.size(); ++c)
      {
        local_cell[cells[c]] = c;
        for (unsigned int f = 0; f < 4; ++f)
          {
            const unsigned int face = faces.sides[cells[c]][f].face;
            if (local_face[face] == none)
              {
                local_face[face] = face_number.size();
                face_number.push_back(face);
              }
            cell_faces[4 * c + f] = local_face[face];
          }
      }
  }

  double
  TractionRelaxation::differentiate(const std::vector<unsigned int> &cells,
                                    const std::vector<double>       &moments)
  {
    state.flexibility.resize(std::size_t(n) * n * cells.size());
    state.gradient.resize(std::size_t(n) * cells.size());
    state.n_cells     = cells.size();
    const auto batch  = std::make_unique<CellBatch>();
    double     energy = 0.;
    CellState  cell_state;
    for (unsigned int c = 0; c < cells.size(); c += CellBatch::size)
      {
        const unsigned int used = std::min<std::size_t>(CellBatch::size, cells.size() - c);
        for (unsigned int lane = 0; lane < CellBatch::size; ++lane)
          {
            const unsigned int cell = cells[c + std::min(lane, used - 1)];
            states.compute(cell, cell_state);
            states.load(cell, cell_state, faces, moments, *batch, lane);
          }
        differentiate_energy(*batch);
        scatter(cells, c, used, *batch);
        for (unsigned int lane = 0; lane < used; ++lane)
          energy += batch->energy[lane];
      }
    return energy;
  }

  void
  TractionRelaxation::scatter(const std::vector<unsigned int> &cells,
                              const unsigned int               c,
                              const unsigned int               used,
                              const CellBatch                 &batch)
  {
    // Place and sign of a cell's functions on the numbered faces.
    unsigned int place[24][CellBatch::size];
    double       sign[24][CellBatch::size];
    for (unsigned int lane = 0; lane < used; ++lane)
      for (unsigned int f = 0; f < 4; ++f)
        for (unsigned int s = 0; s < 6; ++s)
          {
            const auto &side       = faces.sides[cells[c + lane]][f];
            place[6 * f + s][lane] = 18 * f + 3 * side.function(s);
            sign[6 * f + s][lane]  = side.second ? -1. : 1.;
          }
    for (unsigned int i = 0; i < 24; ++i)
      for (unsigned int d = 0; d < 3; ++d)
        for (unsigned int lane = 0; lane < used; ++lane)
          state.gradient[std::size_t(n) * (c + lane) + place[i][lane] + d]
            = sign[i][lane] * batch.gradient[3 * i + d][lane];
    const Lanes *block = batch.flexibility;
    for (unsigned int i = 0; i < 24; ++i)
      for (unsigned int j = 0; j <= i; ++j, block += 9)
        for (unsigned int lane = 0; lane < used; ++lane)
          {
            float             *H    = &state.flexibility[std::size_t(n) * n * (c + lane)];
            const double       both = sign[i][lane] * sign[j][lane];
            const unsigned int p = place[i][lane], q = place[j][lane];
            for (unsigned int d = 0; d < 3; ++d)
              for (unsigned int e = 0; e < 3; ++e)
                {
                  const float value      = both * block[3 * d + e][lane];
                  H[n * (p + d) + q + e] = value;
                  H[n * (q + e) + p + d] = value;
                }
          }
  }

  void
  TractionRelaxation::collect_faces(const std::vector<unsigned int> &cells)
  {
    state.face_moves.clear();
    for (unsigned int c = 0; c < cells.size(); ++c)
      for (unsigned int f = 0; f < 4; ++f)
        {
          const auto         &side  = faces.sides[cells[c]][f];
          const unsigned char mask  = moves.face_components[side.face];
          const bool          inner = faces.boundary[side.face] == none;
          if (side.second || mask == 0)
            continue;
          FaceMove move;
          move.owner      = c;
          move.face       = cell_faces[4 * c + f];
          move.components = mask;
          move.cells[0]   = 4 * c + f;
          move.cells[1]   = none;
          if (inner)
            {
              const unsigned int other = other_side[move.face];
              if (other == none)
                continue;
              move.cells[1] = other;
            }
          for (unsigned int s = 0; s < 3; ++s)
            {
              const auto &face = mesh::face_vertices[f];
              const auto  edge = mesh.points[mesh.cells[cells[c]][face[(s + 1) % 3]]]
                                - mesh.points[mesh.cells[cells[c]][face[s]]];
              for (unsigned int d = 0; d < 3; ++d)
                move.edges[3 * s + d] = edge[d] / edge.norm();
            }
          factorise(state, move);
          state.face_moves.push_back(move);
        }
  }

  void
  TractionRelaxation::collect_rings(const std::vector<unsigned int> &cells)
  {
    state.ring_moves.clear();
    state.turns.clear();
    for (const unsigned int cell : cells)
      for (unsigned int k = moves.cell_begin[cell]; k < moves.cell_begin[cell + 1]; ++k)
        {
          const unsigned int ring   = moves.cell_rings[k];
          bool               inside = true;
          for (unsigned int t = moves.ring_begin[ring]; t < moves.ring_begin[ring + 1]; ++t)
            inside = inside && local_cell[moves.turns[t].cell] != none;
          if (!inside)
            continue;
          RingMove move;
          move.owner = local_cell[cell];
          move.begin = state.turns.size();
          for (unsigned int t = moves.ring_begin[ring]; t < moves.ring_begin[ring + 1]; ++t)
            {
              const auto &global = moves.turns[t];
              RingTurn    turn;
              turn.cell = local_cell[global.cell];
              for (unsigned int i = 0; i < 2; ++i)
                {
                  const auto &side = faces.sides[global.cell][global.face[i]];
                  turn.face[i]     = local_face[side.face];
                  turn.first[i]    = 18 * global.face[i];
                  turn.sign[i]     = (side.second ? -1. : 1.) * (i == 0 ? 1. : -1.);
                  for (unsigned int end = 0; end < 2; ++end)
                    turn.at[i][end] = 3 * global.corner[i][end];
                }
              state.turns.push_back(turn);
            }
          move.end  = state.turns.size();
          move.size = 0;
          for (unsigned int i = 0; i < 6; ++i)
            if ((moves.ring_components[ring] >> (i % 3) & 1) != 0)
              move.components[move.size++] = i;
          factorise(state, move);
          state.ring_moves.push_back(move);
        }
  }

  double
  TractionRelaxation::accelerate(const bool first)
  {
    // With a the change of this sweep and b that of the one before: the minimum
    // of 2 (p ga + q gb) + p^2 aHa + 2 p q aHb + q^2 bHb.
    double aHa = 0., aHb = 0., bHb = 0., ga = 0., gb = 0.;
    for (std::size_t c = 0; c < cell_faces.size() / 4; ++c)
      for (unsigned int f = 0; f < 4; ++f)
        {
          const std::size_t at = 18 * std::size_t(cell_faces[4 * c + f]), in = n * c + 18 * f;
          for (unsigned int i = 0; i < 18; ++i)
            {
              const double a = state.change[at + i] - old_change[at + i], b = direction[at + i];
              const double g = old_gradient[in + i], Ha = state.gradient[in + i] - g;
              aHa += a * Ha;
              aHb += a * image[in + i];
              bHb += b * image[in + i];
              ga += a * g;
              gb += b * g;
            }
        }
    if (!(aHa > 0.))
      return 0.;
    const double determinant = aHa * bHb - aHb * aHb;
    double       p = -ga / aHa, q = 0.;
    if (!first && determinant > 1e-6 * aHa * bHb)
      {
        p = (gb * aHb - ga * bHb) / determinant;
        q = (ga * aHb - gb * aHa) / determinant;
      }
    for (std::size_t i = 0; i < state.change.size(); ++i)
      {
        direction[i]    = p * (state.change[i] - old_change[i]) + q * direction[i];
        state.change[i] = old_change[i] + direction[i];
      }
    for (std::size_t i = 0; i < state.gradient.size(); ++i)
      {
        image[i]          = p * (state.gradient[i] - old_gradient[i]) + q * image[i];
        state.gradient[i] = old_gradient[i] + image[i];
      }
    return -(2. * (p * ga + q * gb) + p * p * aHa + 2. * p * q * aHb + q * q * bHb);
  }

  void
  TractionRelaxation::relax(const std::vector<unsigned int> &cells, std::vector<double> &moments)
  {
    number(cells);
    double energy = differentiate(cells, moments);
    // The second cell of every face between two of the cells.
    other_side.assign(face_number.size(), none);
    for (unsigned int c = 0; c < cells.size(); ++c)
      for (unsigned int f = 0; f < 4; ++f)
        if (faces.sides[cells[c]][f].second)
          other_side[cell_faces[4 * c + f]] = 4 * c + f;
    collect_faces(cells);
    collect_rings(cells);
    state.change.assign(18 * face_number.size(), 0.);
    direction.assign(state.change.size(), 0.);
    image.assign(state.gradient.size(), 0.);
    for (unsigned int sweep = 0; sweep < most_sweeps; ++sweep)
      {
        old_change   = state.change;
        old_gradient = state.gradient;
        make_moves(state);
        const double fall = accelerate(sweep == 0);
        energy -= fall;
        if (!(fall > least_fall * energy))
          break;
      }
    for (unsigned int face = 0; face < face_number.size(); ++face)
      for (unsigned int i = 0; i < 18; ++i)
        moments[18 * std::size_t(face_number[face]) + i]
          += state.change[18 * std::size_t(face) + i];
    for (const unsigned int face : face_number)
      local_face[face] = none;
    for (const unsigned int cell : cells)
      local_cell[cell] = none;
  }
} // namespace tetradapt::estimate
