"""Formulas that effects and the model use, and that the float64 reference writes again for itself."""
