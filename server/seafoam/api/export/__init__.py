"""A scene to take home: the files that draw it without a server, as a zip archive.

Not here: the player, which is built from ``webclient/src/export``.
"""
