"""Regenerates the torus results of the paper through the service's HTTP API, as one HTML page: ./dev reproduce"""
