// SPDX-License-Identifier: AGPL-3.0-or-later
// Empty: the target tetradapt_pch exists for its precompiled headers.
