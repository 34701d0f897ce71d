"""What the tools share: how they read and draw result files, spectra, regions and phase space."""
