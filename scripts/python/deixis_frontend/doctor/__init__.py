"""What `deixis doctor` looks at: each module finds faults of one kind and names the cure."""
