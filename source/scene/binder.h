// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_binder_h
#define tetradapt_scene_binder_h

#include "values.h"

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

namespace tetradapt::scene
{
  /** A deal.II pattern that accepts what a codec can read. */
  template <class T>
  class CodecPattern : public dealii::Patterns::PatternBase
  {
  public:
    explicit CodecPattern(const Codec<T> &codec) : codec(codec)
    {
    }

    bool
    match(const std::string &text) const override
    {
      T value{};
      return codec.read(text, value);
    }

    std::string
    description(const OutputStyle = Machine) const override
    {
      return codec.expected;
    }

    std::unique_ptr<PatternBase>
    clone() const override
    {
      return std::make_unique<CodecPattern<T>>(codec);
    }

  private:
    Codec<T> codec;
  };

  /**
   * Ties parameters to the members of a struct, so that one list serves both to
   * declare them (with the members' values as defaults) and to read them.
   */
  class Binder
  {
  public:
    enum class Action
    {
      declare,
      parse
    };

    Binder(dealii::ParameterHandler &prm, const Action action) : prm(prm), action(action)
    {
    }

    template <class T>
    void
    operator()(const std::string &name,
               T                 &value,
               const Codec<T>    &codec,
               const std::string &documentation)
    {
      if (action == Action::declare)
        prm.declare_entry(name, codec.write(value), CodecPattern<T>(codec), documentation);
      else
        codec.read(prm.get(name), value);
    }

    bool
    parsing() const
    {
      return action == Action::parse;
    }

  private:
    dealii::ParameterHandler &prm;
    const Action              action;
  };

  /** Implements the declare() of a struct whose list of parameters is @p bind. */
  template <class Parameters>
  void
  declare_bound(const Parameters         &parameters,
                dealii::ParameterHandler &prm,
                void (*bind)(Parameters &, Binder &))
  {
    Parameters copy = parameters;
    Binder     binder(prm, Binder::Action::declare);
    bind(copy, binder);
  }

  /** Implements its parse(). */
  template <class Parameters>
  void
  parse_bound(Parameters               &parameters,
              dealii::ParameterHandler &prm,
              void (*bind)(Parameters &, Binder &))
  {
    Binder binder(prm, Binder::Action::parse);
    bind(parameters, binder);
  }
} // namespace tetradapt::scene

#endif
