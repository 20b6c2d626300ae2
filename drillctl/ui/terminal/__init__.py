"""What the verbs print and draw: a job's progress and outcome, reports, charts, image files."""
