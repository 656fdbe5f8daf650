// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_mistakes_h
#define tetradapt_scene_mistakes_h

#include "tetradapt/core/exceptions.h"

#include <functional>
#include <initializer_list>
#include <set>
#include <string>
#include <vector>

namespace tetradapt::scene
{
  /** Several mistakes, thrown together. */
  class SeveralMistakes : public core::InputError
  {
  public:
    /** @p messages must not be empty. */
    explicit SeveralMistakes(const std::vector<std::string> &messages);

    const std::vector<std::string> messages;
  };

  /**
   * Collects the mistakes of an input, so that a user is told all of them at once.
   *
   * Names are full ones: of a parameter ("Loads/tip/Value"), of a block ("Loads/tip") or of a
   * section ("Loads"). What merely follows from a mistake should not be told as another one:
   * readable() and sound() say whether a further look at a part makes sense.
   */
  class Mistakes
  {
  public:
    /** Adds "<name>: <text>"; the part @p name is not sound any more. */
    void
    add(const std::string &name, const std::string &text);

    /** Adds "<name>: <text>" unless @p condition holds, which is returned. */
    bool
    require(bool condition, const std::string &name, const std::string &text);

    /** Adds a whole message, which may begin with its place; @p name, if it is not empty, is not
     * sound any more and, if @p readable is false, not readable either. */
    void
    add_message(const std::string &message, const std::string &name, bool readable = true);

    /** Marks the part @p name as not readable. */
    void
    mark_unreadable(const std::string &name);

    /** Marks all parts as not readable. */
    void
    give_up();

    /**
     * Calls @p action and adds the core::InputError or SeveralMistakes that it throws, if it
     * does: what a message names in front is not sound any more.
     * @return whether nothing was thrown.
     */
    bool
    attempt(const std::function<void()> &action);

    /** As attempt(), but what the message names is not readable any more either. */
    bool
    attempt_reading(const std::function<void()> &action);

    /** Whether everything in the part @p name could be read, so that its own checks mean
     * something. */
    bool
    readable(const std::string &name) const;

    /** Whether nothing is wrong in any of the parts @p names. */
    bool
    sound(std::initializer_list<std::string> names) const;

    bool
    empty() const
    {
      return messages.empty();
    }

    /** The marks of what is not sound and not readable, without the messages. */
    Mistakes
    marks() const;

    /** Adds those of @p other unless they are known already. */
    void
    merge(const Mistakes &other);

    /** As above, each message changed by @p edit. */
    void
    merge(const Mistakes &other, const std::function<std::string(const std::string &)> &edit);

    /** @throws SeveralMistakes or, of a single mistake, core::InputError. */
    void
    throw_together() const;

    /**
     * @throws core::InputError of all mistakes, if there are any: a single one as it is, several
     *         as a list, those in @p file ("file:line: ...") in the order of their lines.
     */
    void
    throw_if_any(const std::string &file) const;

  private:
    bool
    attempt(const std::function<void()> &action, bool stays_readable);

    std::vector<std::string> messages;
    std::set<std::string>    unsound, unreadable;
    bool                     given_up = false;
  };
} // namespace tetradapt::scene

#endif
