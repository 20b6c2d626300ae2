"""Widgets and lines of text that know no machine: dialogs, forms, lists, charts, keys, colours."""
