"""Requests and answers of every route: parameters, errors, entity tags, encodings."""
