"""Shared code of the tools: reading and plotting result files, spectra, regions and phase space."""
