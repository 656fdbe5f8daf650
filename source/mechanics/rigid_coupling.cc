// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/rigid_coupling.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <cmath>

namespace tetradapt::mechanics
{
  namespace
  {
    /** Motion number @p k: a translation by one, or a rotation that moves points at @p length by
     * one. */
    RigidMotion
    unit_motion(const unsigned int k, const double length)
    {
      RigidMotion motion{};
      motion[k] = k < 3 ? 1. : 1. / length;
      return motion;
    }

    /** The distance of the farthest node from the reference point. */
    double
    length_of(const RigidCoupling &coupling)
    {
      double length = 0.;
      for (const Point<3> &x : coupling.positions)
        length = std::max(length, x.distance(coupling.reference));
      return length > 0. ? length : 1.;
    }

    double
    product(const RigidCoupling &coupling, const RigidMotion &a, const RigidMotion &b)
    {
      double sum = 0.;
      for (const Point<3> &x : coupling.positions)
        {
          const Tensor<1, 3> r = x - coupling.reference;
          sum += displacement(a, r) * displacement(b, r);
        }
      return sum;
    }
  } // namespace

  Tensor<1, 3>
  displacement(const RigidMotion &motion, const Tensor<1, 3> &r)
  {
    Tensor<1, 3> t, R;
    for (unsigned int c = 0; c < 3; ++c)
      {
        t[c] = motion[c];
        R[c] = motion[3 + c];
      }
    return t + dealii::cross_product_3d(R, r);
  }

  void
  RigidCoupling::make_basis()
  {
    basis.clear();
    const double length = length_of(*this);
    for (unsigned int k = 0; k < 6; ++k)
      {
        if (prescribed[k])
          continue;
        RigidMotion motion = unit_motion(k, length);
        // Gram and Schmidt, twice. A face has an area, so that all six are independent.
        for (unsigned int repetition = 0; repetition < 2; ++repetition)
          for (const RigidMotion &other : basis)
            {
              const double factor = product(*this, motion, other);
              for (unsigned int i = 0; i < 6; ++i)
                motion[i] -= factor * other[i];
            }
        const double norm = std::sqrt(product(*this, motion, motion));
        for (double &entry : motion)
          entry /= norm;
        basis.push_back(motion);
      }
  }

  std::vector<Tensor<1, 3>>
  RigidCoupling::nodal_forces(const Tensor<1, 3> &force, const Tensor<1, 3> &moment) const
  {
    const double               length = length_of(*this);
    dealii::FullMatrix<double> gram(6, 6);
    for (unsigned int i = 0; i < 6; ++i)
      for (unsigned int j = 0; j < 6; ++j)
        gram(i, j) = product(*this, unit_motion(i, length), unit_motion(j, length));
    gram.gauss_jordan();
    RigidMotion factors{}; // of the motions whose displacements are the forces
    for (unsigned int i = 0; i < 6; ++i)
      for (unsigned int j = 0; j < 6; ++j)
        factors[i] += gram(i, j) * (j < 3 ? force[j] : moment[j - 3] / length);
    for (unsigned int i = 3; i < 6; ++i)
      factors[i] /= length;
    std::vector<Tensor<1, 3>> forces;
    for (const Point<3> &x : positions)
      forces.push_back(displacement(factors, x - reference));
    return forces;
  }

  RigidMotion
  RigidCoupling::motion_of(const fem::Field &field) const
  {
    if (basis.empty())
      return values;
    const fem::Space   &space = field.space();
    std::vector<double> factors(basis.size(), 0.);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      {
        const unsigned int node = space.local_node(nodes[i]);
        if (node >= space.n_owned_nodes())
          continue;
        const Tensor<1, 3> r    = positions[i] - reference;
        const Tensor<1, 3> more = field.value(node) - displacement(values, r);
        for (unsigned int k = 0; k < basis.size(); ++k)
          factors[k] += displacement(basis[k], r) * more;
      }
    dealii::Utilities::MPI::sum(factors, space.communicator(), factors);
    RigidMotion motion = values;
    for (unsigned int k = 0; k < basis.size(); ++k)
      for (unsigned int i = 0; i < 6; ++i)
        motion[i] += factors[k] * basis[k][i];
    return motion;
  }

  RigidCouplings::RigidCouplings(const std::vector<RigidCoupling> &couplings,
                                 const fem::Space                 &space)
    : couplings(couplings), communicator(space.communicator())
  {
    for (unsigned int c = 0; c < couplings.size(); ++c)
      {
        first.push_back(n_free);
        n_free += couplings[c].basis.size();
        if (couplings[c].basis.empty())
          continue; // fixed as any other support fixes nodes
        for (unsigned int i = 0; i < couplings[c].nodes.size(); ++i)
          {
            const unsigned int local = space.local_node(couplings[c].nodes[i]);
            if (local != dealii::numbers::invalid_unsigned_int)
              local_nodes.push_back({local, c, i});
          }
      }
    const auto ghosts
      = std::stable_partition(local_nodes.begin(), local_nodes.end(), [&](const Node &node) {
          return node.local < space.n_owned_nodes();
        });
    n_owned = ghosts - local_nodes.begin();
  }

  Tensor<1, 3>
  RigidCouplings::column(const Node &node, const unsigned int k) const
  {
    const RigidCoupling &coupling = couplings[node.coupling];
    return displacement(coupling.basis[k], coupling.positions[node.index] - coupling.reference);
  }

  template <typename Number>
  std::vector<double>
  RigidCouplings::products(const VectorOf<Number> &x) const
  {
    std::vector<double> result(n_free, 0.);
    for (unsigned int i = 0; i < n_owned; ++i)
      {
        const Node        &node = local_nodes[i];
        const unsigned int n    = couplings[node.coupling].basis.size();
        Tensor<1, 3>       value;
        for (unsigned int c = 0; c < 3; ++c)
          value[c] = x.local_element(3 * node.local + c);
        for (unsigned int k = 0; k < n; ++k)
          result[first[node.coupling] + k] += column(node, k) * value;
      }
    dealii::Utilities::MPI::sum(result, communicator, result);
    return result;
  }

  template <typename Number>
  void
  RigidCouplings::set(const std::vector<double> &coefficients, VectorOf<Number> &x) const
  {
    for (unsigned int i = 0; i < n_owned; ++i)
      {
        const Node        &node = local_nodes[i];
        const unsigned int n    = couplings[node.coupling].basis.size();
        Tensor<1, 3>       value;
        for (unsigned int k = 0; k < n; ++k)
          value += coefficients[first[node.coupling] + k] * column(node, k);
        for (unsigned int c = 0; c < 3; ++c)
          x.local_element(3 * node.local + c) = static_cast<Number>(value[c]);
      }
  }

  template <typename Number>
  void
  RigidCouplings::project(VectorOf<Number> &x) const
  {
    if (!empty())
      set(products(x), x);
  }

  void
  RigidCouplings::add_column(const unsigned int k, Vector &x) const
  {
    std::vector<double> coefficients(n_free, 0.);
    coefficients[k] = 1.;
    Vector column(x);
    column = 0.;
    set(coefficients, column);
    x += column;
  }

  template <typename Number>
  void
  RigidCouplings::clear(VectorOf<Number> &x) const
  {
    for (unsigned int i = 0; i < n_owned; ++i)
      for (unsigned int c = 0; c < 3; ++c)
        x.local_element(3 * local_nodes[i].local + c) = Number(0);
  }

  void
  RigidCouplings::add_prescribed(const double factor, Vector &x) const
  {
    for (unsigned int i = 0; i < n_owned; ++i)
      {
        const Node          &node     = local_nodes[i];
        const RigidCoupling &coupling = couplings[node.coupling];
        const Tensor<1, 3>   value
          = displacement(coupling.values, coupling.positions[node.index] - coupling.reference);
        for (unsigned int c = 0; c < 3; ++c)
          x.local_element(3 * node.local + c) += factor * value[c];
      }
  }

  bool
  RigidCouplings::is_homogeneous() const
  {
    return std::all_of(couplings.begin(), couplings.end(), [](const RigidCoupling &coupling) {
      return coupling.basis.empty() || coupling.values == RigidMotion{};
    });
  }

  template std::vector<double>
  RigidCouplings::products(const VectorOf<double> &) const;
  template std::vector<double>
  RigidCouplings::products(const VectorOf<float> &) const;
  template void
  RigidCouplings::project(VectorOf<double> &) const;
  template void
  RigidCouplings::set(const std::vector<double> &, VectorOf<double> &) const;
  template void
  RigidCouplings::clear(VectorOf<double> &) const;
  template void
  RigidCouplings::clear(VectorOf<float> &) const;
} // namespace tetradapt::mechanics
