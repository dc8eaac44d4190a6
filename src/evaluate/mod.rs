//! Syntax to garment: names, modules, units, parameters, and the words of the language.
