// SPDX-License-Identifier: AGPL-3.0-or-later
// Conditions are taken apart into leaves that together say what the expression says;
// what is no condition is refused with what was probably meant.

#include "tetradapt/core/condition.h"

#include "tetradapt/core/exceptions.h"

#include <iostream>
#include <random>

using namespace tetradapt::core;

const char *
name(const ConditionLeaf::Kind kind)
{
  const char *const names[] = {"affine", "sphere", "cylinder", "general", "truth", "constant"};
  return names[static_cast<int>(kind)];
}

/** Prints the leaves, and whether they agree with the expression at random points. */
void
take_apart(const std::string &text)
{
  const Condition                        condition(text, "Where");
  std::mt19937                           random(7);
  std::uniform_real_distribution<double> coordinate(-1.5, 1.5);
  unsigned int                           differences = 0, inside = 0;
  for (unsigned int i = 0; i < 2000; ++i)
    {
      const Point<3>    p(coordinate(random), coordinate(random), coordinate(random));
      std::vector<bool> leaves;
      for (const ConditionLeaf &leaf : condition.leaves())
        leaves.push_back(leaf.level(p) < 0.);
      const bool holds = condition.holds(p);
      inside += holds ? 1 : 0;
      differences += holds != condition.combine(leaves) ? 1 : 0;
    }
  std::cout << text << ":";
  for (const ConditionLeaf &leaf : condition.leaves())
    {
      std::cout << " " << name(leaf.kind);
      if (leaf.kind == ConditionLeaf::Kind::affine)
        std::cout << (leaf.includes_border ? "[" : "(") << leaf.normal << " | " << leaf.offset
                  << (leaf.includes_border ? "]" : ")");
    }
  std::cout << "; " << differences << " of 2000 differ, "
            << (inside == 0      ? "never holds"
                : inside == 2000 ? "always holds"
                                 : "holds at some")
            << std::endl;
}

template <typename Action>
void
expect_error(const Action &action)
{
  try
    {
      action();
      std::cout << "NOT REFUSED" << std::endl;
    }
  catch (const InputError &error)
    {
      std::cout << error.what() << std::endl;
    }
}

void
refuse(const std::string &text)
{
  expect_error([&] { Condition(text, "Loads/l/Where").holds({.5, .3, .2}); });
}

void
values()
{
  const Point<3> p(.25, .5, .125);
  for (const char *text :
       {"if(sphere(.25,.5,0, .125), 7, 2)",
        "if(sphere(.25,.5,0, .12), 7, 2)",
        "3*box(1,1,1, 0,0,0) + half_space(0,.5,0, 0,2,0)",
        "half_space(0,.4,0, 0,2,0) + 10*half_space(0,.4,0, 0,-2,0)",
        "cylinder(.25,.4,0, .25,.4,.125, .1) + cylinder(.25,.4,0, .25,.4,.1, .1)",
        "cylinder(0,.5,.125, 1,.5,.125, 0)"})
    std::cout << text << " = " << Expression(text, "Value")(p) << std::endl;
}

int
main()
{
  for (const char *text : {"x < 1e-9",
                           "z >= 1 - 1e-9 && x < 0.5 + 1e-9",
                           "abs(x)<.25 && abs(y - z/2)<=.25",
                           "abs(x) > 1 || .5 < abs(y)",
                           "min(z, 0.5 - z) < 1e-9",
                           "max(abs(x), abs(y)) > 1 - 1e-9",
                           "max(x, y, z) <= min(1, x + .5)",
                           "2*(x - y)/4 < -(1 - sin(pi/6)*z)^1 + 2^-1",
                           "(x/1.25)^2 + (y/.75)^2 > 0.95",
                           "x*y < .1",
                           "!(x < 0) && !sphere(0,0,0, 1.2)",
                           "sphere(.5,0,0, .75) || box(-1,-1,-1, 0,0.5,1)",
                           "cylinder(0,0,-1, 0,1,1, .6)",
                           "half_space(.1,.2,.3, 1,-2,2) && x > -1",
                           "if(x < 0, y < 0, y > 1)",
                           "x < 0 ? y < 0 : z < 0 ? y > 1 : y < .5",
                           "(x < 0) * (y < 0.5) * sphere(0,0,0, 1)",
                           "(x < 0) + (y < 0)*(x >= 0)",
                           "mod(floor(4*(x + 2)), 2)",
                           "(x < 0) == (y < 0)",
                           "if(x < 0, 2, 3) > 2.5",
                           "1/x > 2",
                           "1",
                           "1 < 2 || x < 0",
                           "x - x > 1",
                           "((x<.5)&&((y<.5)))",
                           "sphere(x,0,0, 1)"})
    take_apart(text);
  for (const char *text : {"z = 1",
                           "9.9 < x < 20.1",
                           "z > 1 && (0 <= x + y < 1 || y > 2)",
                           "x < y == 1",
                           "x => 1",
                           "x < 1 & y < 1",
                           "x < 1 | y < 1",
                           "x < 1 and y < 1",
                           "x",
                           "x - 1",
                           "2",
                           "sin(x)",
                           "(x < 1) + (y < 1)",
                           "!x < 1",
                           "x < t",
                           "",
                           "x <",
                           "x < 1, y < 1",
                           "sphere(0,0,0)",
                           "sphere(0,0,0, -1)",
                           "cylinder(0,0,0, 0,0,0, 1)",
                           "half_space(0,0,0, 0,0,0)",
                           "box < 1"})
    refuse(text);
  std::cout << Condition("x < t", "Where", true).holds({.5, 0., 0.}, 1.) << std::endl;
  values();
  expect_error([] { Expression("if(z = 1, 2, 3)", "Loads/l/Value"); });
  expect_error([] { Expression("if(0 < z < 1, 2, 3)", "Loads/l/Value"); });
}
